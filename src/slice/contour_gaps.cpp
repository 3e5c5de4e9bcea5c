// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_gaps.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/status.h"
#include "slice/cell_sides.h"

namespace msq {

namespace {

/// Of the pitch: with a greater tolerance, cells are not divided.
constexpr double max_gap_tolerance = 0.125;
/// Of a part of a cell: crossings keep a margin away from its nodes.
constexpr double min_margins_of_part = 4;
/// Cells whose nodes are found together.
constexpr size_t cells_at_once = 256;
/// Cells are divided until there are so many: some, and a share of the layer's crossings.
constexpr uint64_t some_cells = 1024, crossings_of_cell = 32;

}  // namespace

uint32_t gap_parts(double pitch, double tolerance, double margin) {
  if (tolerance > max_gap_tolerance * pitch) return 1;
  const double parts = std::min({std::ceil(pitch / tolerance), double{max_gap_parts},
                                 std::floor(pitch / (min_margins_of_part * margin))});
  return std::max(1u, static_cast<uint32_t>(parts));
}

Vec2 ContourGaps::node(const Cell& cell, uint32_t i, uint32_t j) const {
  const ContourGrid& grid = section_.grid();
  const double part = grid.pitch() / parts_;
  return {grid.u(cell.column) + i * part, grid.v(cell.row) + j * part};
}

uint64_t ContourGaps::most_cells() const {
  return some_cells + section_.count() / crossings_of_cell;
}

void ContourGaps::hold() {
  constexpr uint64_t of_index = 6 * sizeof(uint64_t);
  held_.grow_to(section_.grid().words() * sizeof(uint64_t) +
                    cells_.size() * (sizeof(Cell) + of_index + sizeof(Joint)) +
                    edges_at_once * max_gap_parts * ContourPoints::bytes_of_point,
                "the gaps of a layer");
}

void ContourGaps::find(ContourPoints& points) {
  if (parts_ == 1 || section_.count() == 0) return;
  const std::vector<Edge> open = find_open(find_tips(points.job()), points);
  held_ = Reservation(points.model().context().budget, 0, "");
  hold();
  for (const Edge& e : open) {
    if (cells_.size() >= most_cells()) {
      ++unresolved_;
      continue;
    }
    add(e.column, e.row);
    e.is_horizontal ? add(e.column, e.row - 1) : add(e.column - 1, e.row);
  }
  for (const ContourSection::Saddle& s : section_.saddles())
    if (s.turns_right == s.is_rising && cells_.size() < most_cells())
      add(s.column, s.row);  // its centre is inside
  if (cells_.empty()) return;
  divide(points);
  close_border();
  look_within(points);
  finish();
}

void ContourGaps::add(uint32_t column, uint32_t row) {
  using namespace cell_sides;
  if (!section_.grid().is_inner_cell(column, row)) return;
  const uint32_t number = static_cast<uint32_t>(cells_.size());
  if (!index_.emplace(key(column, row), number).second) return;
  Cell& cell = cells_.emplace_back();
  cell.column = column;
  cell.row = row;
  std::fill(std::begin(cell.rows), std::end(cell.rows), 0u);
  std::fill(std::begin(cell.rings), std::end(cell.rings), ContourSection::no_ring);
  const uint32_t beside[4][2] = {
      {column, row - 1}, {column + 1, row}, {column, row + 1}, {column - 1, row}};
  for (uint32_t side = bottom; side <= left; ++side) {
    const auto found = index_.find(key(beside[side][0], beside[side][1]));
    cell.neighbours[side] = found == index_.end() ? none : found->second;
    if (found != index_.end()) cells_[found->second].neighbours[(side + 2) % 4] = number;
  }
}

/// Nodes of a side as bits, in the order of u or v.
uint32_t ContourGaps::edge_of(const Cell& cell, uint32_t side) const {
  using namespace cell_sides;
  if (side == bottom) return cell.rows[0];
  if (side == top) return cell.rows[parts_];
  const uint32_t i = side == left ? 0 : parts_;
  uint32_t bits = 0;
  for (uint32_t j = 0; j <= parts_; ++j) bits |= (cell.rows[j] >> i & 1) << j;
  return bits;
}

void ContourGaps::set_edge(Cell& cell, uint32_t side, uint32_t bits) const {
  using namespace cell_sides;
  if (side == bottom || side == top) {
    cell.rows[side == bottom ? 0 : parts_] = bits;
    return;
  }
  const uint32_t i = side == left ? 0 : parts_;
  for (uint32_t j = 0; j <= parts_; ++j)
    cell.rows[j] = (cell.rows[j] & ~(1u << i)) | (bits >> j & 1) << i;
}

/// Divides cells until the boundary leaves them only where the grid has crossings.
void ContourGaps::divide(ContourPoints& points) {
  using namespace cell_sides;
  const uint64_t most = most_cells();
  for (size_t first = 0; first < cells_.size();) {
    hold();
    const size_t end = cells_.size();
    look_at_sides(first, points);
    for (size_t n = first; n < end; ++n)
      for (uint32_t side = bottom; side <= left; ++side) {
        if (cells_[n].neighbours[side] != none || !goes_on(cells_[n], side)) continue;
        const uint32_t column = cells_[n].column + (side == right) - (side == left),
                       row = cells_[n].row + (side == top) - (side == bottom);
        if (end < most && section_.grid().is_inner_cell(column, row))
          add(column, row);
        else
          ++unresolved_;
      }
    first = end;
  }
  hold();
}

/// Whether a side has other crossings than the grid.
bool ContourGaps::goes_on(const Cell& cell, uint32_t side) const {
  const uint32_t bits = edge_of(cell, side);
  const uint32_t changes = (bits ^ bits >> 1) & ((1u << parts_) - 1);
  return (changes & (changes - 1)) != 0;
}

/// Nodes on the sides of cells from `first` on.
void ContourGaps::look_at_sides(size_t first, ContourPoints& points) {
  using namespace cell_sides;
  const ContourGrid& grid = section_.grid();
  const auto is_known = [&](size_t n, uint32_t side) {
    return cells_[n].neighbours[side] < n;  // none is greater
  };
  for (size_t from = first; from < cells_.size(); from += edges_at_once / 4) {
    const size_t end = std::min(cells_.size(), from + edges_at_once / 4);
    points.clear();
    for (size_t n = from; n < end; ++n)
      for (uint32_t side = bottom; side <= left; ++side) {
        if (is_known(n, side)) continue;
        const bool is_flat = side == bottom || side == top;
        const uint32_t across = side == right || side == top ? parts_ : 0;
        for (uint32_t i = 1; i < parts_; ++i)
          points.add(node(cells_[n], is_flat ? i : across, is_flat ? across : i));
      }
    const std::vector<uint8_t>& inside = points.find_inside();
    size_t next = 0;
    for (size_t n = from; n < end; ++n) {
      Cell& cell = cells_[n];
      for (uint32_t side = bottom; side <= left; ++side) {
        uint32_t bits = 0;
        if (is_known(n, side)) {
          bits = edge_of(cells_[cell.neighbours[side]], (side + 2) % 4);
        } else {
          const uint32_t c = cell.column + (side == right), r = cell.row + (side == top);
          bits = grid.inside(c, r);
          bits |= (side == bottom || side == top ? grid.inside(c + 1, r) : grid.inside(c, r + 1))
                      ? 1u << parts_
                      : 0u;
          for (uint32_t i = 1; i < parts_; ++i) bits |= uint32_t{inside[next++]} << i;
        }
        set_edge(cell, side, bits);
      }
    }
  }
}

/// The grid's crossing on a side, or none.
uint32_t ContourGaps::border_bits(const Cell& cell, uint32_t side) const {
  using namespace cell_sides;
  const ContourGrid& grid = section_.grid();
  const bool is_flat = side == bottom || side == top;
  const uint32_t c = cell.column + (side == right), r = cell.row + (side == top);
  const bool a = grid.inside(c, r), b = is_flat ? grid.inside(c + 1, r) : grid.inside(c, r + 1);
  const uint32_t all = (2u << parts_) - 1;
  if (a == b) return a ? all : 0;
  const uint32_t id = section_.crossing_of(is_flat, c, r);
  const double at = (a ? -1 : 1) * section_.ends()[id] - (is_flat ? grid.u(c) : grid.v(r));
  const double part = grid.pitch() / parts_;
  // Nodes before the crossing.
  uint32_t before = 1;
  while (before < parts_ && before * part < at) ++before;
  const uint32_t low = (1u << before) - 1;
  return a ? low : all & ~low;
}

void ContourGaps::close_border() {
  using namespace cell_sides;
  for (Cell& cell : cells_)
    for (uint32_t side = bottom; side <= left; ++side)
      if (cell.neighbours[side] == none) set_edge(cell, side, border_bits(cell, side));
}

/// Nodes that are not on sides: those next to the boundary, step by step from the sides on. The
/// others are as their neighbours.
void ContourGaps::look_within(ContourPoints& points) {
  struct Look {
    uint32_t known[max_gap_parts + 1], wanted[max_gap_parts + 1];
  };
  const uint32_t all = (2u << parts_) - 1, sides = 1u | 1u << parts_;
  std::vector<Look> looks(std::min(cells_at_once, cells_.size()));
  for (size_t first = 0; first < cells_.size(); first += cells_at_once) {
    const size_t count = std::min(cells_.size() - first, cells_at_once);
    for (size_t n = 0; n < count; ++n)
      for (uint32_t j = 0; j <= parts_; ++j)
        looks[n].known[j] = j == 0 || j == parts_ ? all : sides;
    for (;;) {
      points.clear();
      for (size_t n = 0; n < count; ++n) {
        const Cell& cell = cells_[first + n];
        uint32_t *const known = looks[n].known, *const wanted = looks[n].wanted;
        std::fill_n(wanted, parts_ + 1, 0u);
        // All corners of the parts on both sides of an edge with a crossing.
        for (uint32_t j = 0; j <= parts_; ++j) {
          const uint32_t row = cell.rows[j];
          const uint32_t along = (row ^ row >> 1) & known[j] & known[j] >> 1;
          for (const uint32_t beside : {j - 1, j + 1})
            if (beside <= parts_) wanted[beside] |= along | along << 1;
          if (j == parts_) continue;
          const uint32_t up = (row ^ cell.rows[j + 1]) & known[j] & known[j + 1];
          wanted[j] |= up << 1 | up >> 1;
          wanted[j + 1] |= up << 1 | up >> 1;
        }
        for (uint32_t j = 1; j < parts_; ++j) {
          wanted[j] &= all & ~known[j];
          for (uint32_t rest = wanted[j]; rest; rest &= rest - 1)
            points.add(node(cell, static_cast<uint32_t>(std::countr_zero(rest)), j));
        }
      }
      if (points.count() == 0) break;
      const std::vector<uint8_t>& inside = points.find_inside();
      size_t next = 0;
      for (size_t n = 0; n < count; ++n)
        for (uint32_t j = 1; j < parts_; ++j) {
          looks[n].known[j] |= looks[n].wanted[j];
          for (uint32_t rest = looks[n].wanted[j]; rest; rest &= rest - 1)
            cells_[first + n].rows[j] |= uint32_t{inside[next++]} << std::countr_zero(rest);
        }
    }
    for (size_t n = 0; n < count; ++n)
      for (uint32_t j = 1; j < parts_; ++j) {
        uint32_t& row = cells_[first + n].rows[j];
        for (uint32_t i = 1; i < parts_; ++i)
          if (!(looks[n].known[j] >> i & 1)) row |= (row >> (i - 1) & 1) << i;
      }
  }
}

void ContourGaps::finish() {
  using namespace cell_sides;
  const ContourGrid& grid = section_.grid();
  std::vector<uint64_t>& bits = memory_->bits;
  bits.assign(grid.words(), 0);
  for (uint32_t n = 0; n < cells_.size(); ++n) {
    const Cell& cell = cells_[n];
    bits[cell.row * grid.row_words() + cell.column / 64] |= uint64_t{1} << (cell.column % 64);
    if (cell.neighbours[bottom] != none) joints_.push_back({cell.row, cell.column, n});
    for (uint32_t j = 0; j <= parts_; ++j) {
      const uint32_t row = cell.rows[j];
      crossing_count_ +=
          static_cast<uint64_t>(std::popcount((row ^ row >> 1) & ((1u << parts_) - 1)));
      if (j < parts_)
        crossing_count_ += static_cast<uint64_t>(std::popcount(row ^ cell.rows[j + 1]));
    }
    const bool lower = cell.rows[0] & 1, upper = cell.rows[parts_] & 1;
    const bool lower_right = cell.rows[0] >> parts_ & 1,
               upper_right = cell.rows[parts_] >> parts_ & 1;
    saddles_ += lower == upper_right && upper == lower_right && lower != upper;
  }
  if (section_.count() + crossing_count_ >= UINT32_MAX)
    fail(Status::limit, "the layer has %llu crossings; the limit is %u",
         static_cast<unsigned long long>(section_.count() + crossing_count_), UINT32_MAX - 1);
  std::sort(joints_.begin(), joints_.end(), [](const Joint& a, const Joint& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
}

}  // namespace msq
