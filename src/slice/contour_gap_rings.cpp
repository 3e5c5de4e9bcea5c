// SPDX-License-Identifier: Apache-2.0
// Rings in divided cells: their way, their crossings, and their topology.
#include <algorithm>
#include <bit>
#include <unordered_set>

#include "slice/cell_sides.h"
#include "slice/contour_gaps.h"
#include "slice/contour_topology_cells.h"

namespace msq {

std::span<const ContourGaps::Joint> ContourGaps::joints(uint32_t row) const {
  const auto first = std::lower_bound(joints_.begin(), joints_.end(), row,
                                      [](const Joint& j, uint32_t r) { return j.row < r; });
  auto end = first;
  while (end != joints_.end() && end->row == row) ++end;
  return {first, end};
}

ContourGaps::Place ContourGaps::enter(uint32_t cell, uint32_t side) const {
  using namespace cell_sides;
  const uint32_t bits = edge_of(cells_[cell], (side + 2) % 4);
  const uint32_t n = static_cast<uint32_t>(std::countr_zero(bits ^ bits >> 1));
  const uint32_t last = parts_ - 1;
  switch (side) {
    case bottom:
      return {cell, n, last, side};
    case right:
      return {cell, 0, n, side};
    case top:
      return {cell, n, 0, side};
    default:
      return {cell, last, n, side};
  }
}

ContourGaps::Place ContourGaps::start(uint32_t cell, uint32_t i) const {
  using namespace cell_sides;
  // It goes up where the first node is inside.
  if (cells_[cell].rows[0] >> i & 1) return {cell, i, 0, top};
  return {cells_[cell].neighbours[bottom], i, parts_ - 1, bottom};
}

uint32_t* ContourGaps::ring_before(const Place& p) {
  using namespace cell_sides;
  if (p.side == top && p.j == 0) return &cells_[p.cell].rings[p.i];
  if (p.side == bottom && p.j == parts_ - 1 && cells_[p.cell].neighbours[top] != none)
    return &cells_[cells_[p.cell].neighbours[top]].rings[p.i];
  return nullptr;
}

GapCrossing ContourGaps::crossing_before(const Place& p) const {
  using namespace cell_sides;
  const uint32_t i = p.i + (p.side == left), j = p.j + (p.side == bottom);
  return {0,
          p.cell,
          static_cast<uint8_t>(i),
          static_cast<uint8_t>(j),
          p.side == bottom || p.side == top,
          (cells_[p.cell].rows[j] >> i & 1) != 0,
          static_cast<uint8_t>(p.i),
          static_cast<uint8_t>(p.j)};
}

bool ContourGaps::is_saddle(const Place& p) const {
  const uint32_t low = cells_[p.cell].rows[p.j] >> p.i & 3;
  const uint32_t high = cells_[p.cell].rows[p.j + 1] >> p.i & 3;
  return low + high == 3 && low != 0 && high != 0;  // 1 and 2
}

void ContourGaps::part_behind(const GapCrossing& c, Vec2& low, Vec2& high) const {
  const Cell& cell = cells_[c.cell];
  low = node(cell, c.part_i, c.part_j);
  high = node(cell, c.part_i + 1u, c.part_j + 1u);
}

// As RingSteps; saddles connect what is outside, which keeps gaps whole.
bool ContourGaps::step(Place& p) const {
  using namespace cell_sides;
  const Cell& cell = cells_[p.cell];
  const uint32_t low = cell.rows[p.j] >> p.i & 3, high = cell.rows[p.j + 1] >> p.i & 3;
  const uint32_t around = low | high << 2;
  constexpr uint32_t ahead[4][2] = {{1, 0}, {3, 1}, {2, 3}, {0, 2}};
  const bool is_left = around >> ahead[p.side][0] & 1, is_right = around >> ahead[p.side][1] & 1;
  p.side = (p.side + (is_left ? (is_right ? 3 : 0) : 1)) % 4;
  const bool is_last = p.side == bottom  ? p.j == 0
                       : p.side == right ? p.i + 1 == parts_
                       : p.side == top   ? p.j + 1 == parts_
                                         : p.i == 0;
  if (is_last) {
    if (cell.neighbours[p.side] == none) return false;
    p.cell = cell.neighbours[p.side];
  }
  const uint32_t last = parts_ - 1;
  switch (p.side) {
    case bottom:
      p.j = is_last ? last : p.j - 1;
      break;
    case right:
      p.i = is_last ? 0 : p.i + 1;
      break;
    case top:
      p.j = is_last ? 0 : p.j + 1;
      break;
    default:
      p.i = is_last ? last : p.i - 1;
  }
  return true;
}

void ContourGaps::locate(std::span<const GapCrossing> crossings, double accuracy,
                         ContourPoints& points, double* x, double* y) const {
  struct Search {
    Vec2 outside, inside;
  };
  const double part = section_.grid().pitch() / parts_, margin = section_.margin();
  const Reservation held(points.model().context().budget,
                         edges_at_once * (ContourPoints::bytes_of_point + sizeof(Search)),
                         "the gaps of a layer");
  std::vector<Search> searches;
  for (size_t first = 0; first < crossings.size(); first += edges_at_once) {
    const auto some = crossings.subspan(first, std::min(edges_at_once, crossings.size() - first));
    searches.clear();
    for (const GapCrossing& c : some) {
      const Cell& cell = cells_[c.cell];
      const Vec2 a = node(cell, c.i, c.j),
                 b = node(cell, c.i + c.is_horizontal, c.j + !c.is_horizontal);
      searches.push_back(c.starts_inside ? Search{b, a} : Search{a, b});
    }
    for (double size = part; 0.5 * size > accuracy; size *= 0.5) {
      points.clear();
      for (const Search& s : searches) points.add((s.outside + s.inside) * 0.5);
      const std::vector<uint8_t>& inside = points.find_inside();
      for (size_t n = 0; n < searches.size(); ++n)
        (inside[n] ? searches[n].inside : searches[n].outside) = points.at(n);
    }
    for (size_t n = 0; n < some.size(); ++n) {
      const GapCrossing& c = some[n];
      const Vec2 low = node(cells_[c.cell], c.i, c.j);
      Vec2 at = (searches[n].outside + searches[n].inside) * 0.5;
      if (c.is_horizontal)
        at.x = std::clamp(at.x, low.x + margin, low.x + part - margin);
      else
        at.y = std::clamp(at.y, low.y + margin, low.y + part - margin);
      x[c.id] = at.x;
      y[c.id] = at.y;
    }
  }
}

LineGate ContourGaps::gate(const GapCrossing& c, Vec2 at, double tolerance) const {
  const double part = section_.grid().pitch() / parts_, margin = section_.margin();
  const Vec2 start = node(cells_[c.cell], c.i, c.j);
  const double middle = c.is_horizontal ? at.x : at.y, from = c.is_horizontal ? start.x : start.y;
  const double low = std::max(middle - tolerance, from + margin);
  const double high = std::min(middle + tolerance, from + part - margin);
  const double left_end = c.starts_inside ? low : high, right_end = c.starts_inside ? high : low;
  return c.is_horizontal ? LineGate{left_end, right_end, at.y, at.y}
                         : LineGate{at.x, at.x, left_end, right_end};
}

uint64_t ContourGaps::count_topology_steps(const Job* job) const {
  if (cells_.empty()) return 0;
  std::vector<uint32_t> order(cells_.size());
  for (uint32_t n = 0; n < order.size(); ++n) order[n] = n;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(cells_[a].row, cells_[a].column) < std::pair(cells_[b].row, cells_[b].column);
  });
  TopologyCells cells;
  uint64_t saddles = 0;  // the mask connects the solid there
  for (const uint32_t n : order) {
    const Cell& cell = cells_[n];
    for (uint32_t j = 0; j < parts_; ++j) {
      const uint32_t low = cell.rows[j], high = cell.rows[j + 1];
      const uint32_t are_saddles = (low ^ low >> 1) & (low ^ high) & (high ^ high >> 1);
      saddles += static_cast<uint64_t>(std::popcount(are_saddles & ((1u << parts_) - 1)));
    }
    CellMask mask{parts_, {}};
    std::copy_n(cell.rows, parts_ + 1, mask.rows);
    const bool corner = mask.at(0, 0);
    const bool is_saddle = corner == mask.at(parts_, parts_) && corner != mask.at(parts_, 0) &&
                           corner != mask.at(0, parts_);
    cells.add(cell.column, cell.row, mask,
              is_saddle && section_.saddle_at(cell.column, cell.row).turns_right, 0);
  }
  return cells.steps(job) + saddles + left_out(job);
}

/// The number of closed curves that meet no joint.
uint64_t ContourGaps::left_out(const Job* job) const {
  using namespace cell_sides;
  std::unordered_set<uint64_t> seen;
  const auto name = [&](const Place& p) {
    return (uint64_t{p.cell} * parts_ + p.j) * parts_ + p.i;
  };
  uint64_t count = 0;
  CancelPoll poll(job);
  for (uint32_t n = 0; n < cells_.size(); ++n)
    for (uint32_t j = 0; j < parts_; ++j)
      for (uint32_t i = 0; i < parts_; ++i) {
        poll();
        const bool low = cells_[n].rows[j] >> i & 1, high = cells_[n].rows[j + 1] >> i & 1;
        // Where the lower node is inside, the curve goes to the left.
        if (low || !high) continue;
        const Place first{n, i, j, right};
        if (!seen.insert(name(first)).second) continue;
        Place place = first;
        bool is_closed = false, has_joint = false;
        while (!is_closed && step(place)) {
          is_closed = place == first;
          has_joint = has_joint || (place.side == top && place.j == 0) ||
                      (place.side == bottom && place.j == parts_ - 1);
          if (place.side == right) seen.insert(name(place));
        }
        count += is_closed && !has_joint;
      }
  return count;
}

}  // namespace msq
