// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_rings.h"

#include <algorithm>
#include <bit>

#include "base/simd.h"
#include "slice/cell_sides.h"

namespace msq {

namespace {

/// Rings lead through rows above their lowest one.
constexpr uint32_t rows_ahead = 24;
/// What is known of so many crossings stays in the core's cache while they are looked into.
constexpr uint32_t crossings_at_once = 1 << 12;
/// Where membership costs less for many points at once.
constexpr uint32_t many_crossings_at_once = 1 << 14;
/// Room at first; then for all.
constexpr uint32_t first_room = many_crossings_at_once;

constexpr uint64_t cell_at(uint32_t column, uint32_t row) {
  return column | uint64_t{row} << 32;
}
constexpr uint32_t column_of(uint64_t cell) {
  return static_cast<uint32_t>(cell);
}
constexpr uint32_t row_of(uint64_t cell) {
  return static_cast<uint32_t>(cell >> 32);
}

InnerCells inner_cells(const ContourGrid& grid) {
  return {cell_at(ContourGrid::first_inner, ContourGrid::first_inner_row),
          cell_at(grid.right_edge() - 2, grid.top_edge() - 2)};
}

}  // namespace

ContourRings::ContourRings(const ContourSection& section, ContourGaps& gaps, bool has_struts,
                           double accuracy)
    : grid_(section.grid()),
      gaps_(gaps),
      accuracy_(accuracy),
      at_once_(has_struts ? crossings_at_once : many_crossings_at_once),
      axes_{{grid_.u_nodes().first(), grid_.pitch(), grid_.u_nodes().low(), grid_.u_nodes().high(),
             ContourGrid::first_inner, ContourGrid::left_beyond, ContourGrid::left_edge,
             grid_.right_edge()},
            {grid_.v_nodes().first(), grid_.pitch(), grid_.v_nodes().low(), grid_.v_nodes().high(),
             ContourGrid::first_inner_row, 0, ContourGrid::bottom_row, grid_.top_edge()}},
      margin_(section.margin()),
      nodes_{grid_.u_nodes().first(),  grid_.v_nodes().first(),      grid_.pitch(),
             ContourGrid::first_inner, ContourGrid::first_inner_row, margin_},
      steps_(grid_.row_words()),
      most_(static_cast<uint32_t>(section.count() + gaps.crossing_count())),
      room_(std::min(most_, first_room)) {
  if (memory_->x.size() < room_ + max_simd_doubles) memory_->resize(room_ + max_simd_doubles);
  room_ = static_cast<uint32_t>(std::min<size_t>(most_, memory_->x.size() - max_simd_doubles));
}

uint64_t ContourRings::bytes(uint64_t crossings) {
  constexpr uint64_t bytes_of_crossing = 3 * sizeof(double) + sizeof(uint64_t) + sizeof(uint8_t);
  // Where there is no room for a ring, it is copied to where there is.
  return (crossings + std::min<uint64_t>(crossings, first_room) + 2 * max_simd_doubles) *
         bytes_of_crossing;
}

// A crossing that has no ring yet is the leftmost one on the ring's lowest row, so what is to its
// left is around the ring. The crossing before it on the row, if any, is of a ring that borders on
// the same.
void ContourRings::follow_all(ContourSection& section, ContourPoints& points,
                              const std::function<void()>& visit) {
  const Job* const job = points.job();
  const auto visit_these = [&] {
    place(points);
    visit();
    rings_before_ += static_cast<uint32_t>(rings_.size());
    rings_.clear();
    gap_crossings_.clear();
    count_ = 0;
  };
  const auto add = [&](uint32_t id, uint32_t column, uint32_t row, uint32_t beside) {
    follow(section, id, column, row, beside, job);
    if (count() >= at_once_) visit_these();
  };
  const auto add_from_gap = [&](const ContourGaps::Place& start, bool goes_up, uint32_t beside) {
    follow_from_gap(section, start, goes_up, beside, job);
    if (count() >= at_once_) visit_these();
  };
  const uint32_t* const rings = section.rings();
  uint32_t id = 0;
  for (uint32_t r = 0; r < grid_.rows(); ++r) {
    check_cancelled(job);
    section.prefetch(r + rows_ahead);
    if (const auto joints = gaps_.joints(r); !joints.empty()) {
      id = follow_row(section, joints, r, id, add, add_from_gap);
      continue;
    }
    const uint32_t row_start = id;
    for (size_t w = 0; w < grid_.row_words(); ++w)
      for (uint64_t rest = section.horizontal(r, w); rest; rest &= rest - 1, ++id) {
        if (rings[id] != ContourSection::no_ring) continue;
        add(id, static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest)), r,
            id > row_start ? rings[id - 1] : none);
      }
  }
  visit_these();
}

/// A row of nodes with joints, whose crossings take the place of the grid's there. `id`: its first
/// crossing. Returns the first one of the next row.
template <class Add, class AddFromGap>
uint32_t ContourRings::follow_row(const ContourSection& section,
                                  std::span<const ContourGaps::Joint> joints, uint32_t row,
                                  uint32_t id, Add&& add, AddFromGap&& add_from_gap) {
  uint32_t beside = none;
  auto joint = joints.begin();
  const auto pass_joint = [&] {
    const uint32_t nodes = gaps_.nodes_below(joint->cell);
    for (uint32_t i = 0; i < gaps_.parts(); ++i) {
      if ((nodes >> i & 1) == (nodes >> (i + 1) & 1)) continue;
      const ContourGaps::Place start = gaps_.start(joint->cell, i);
      const uint32_t* const ring = gaps_.ring_before(start);
      if (*ring == ContourSection::no_ring) add_from_gap(start, (nodes >> i & 1) != 0, beside);
      beside = *ring;
    }
    ++joint;
  };
  for (size_t w = 0; w < grid_.row_words(); ++w)
    for (uint64_t rest = section.horizontal(row, w); rest; rest &= rest - 1, ++id) {
      const uint32_t column =
          static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest));
      while (joint != joints.end() && joint->column < column) pass_joint();
      if (joint != joints.end() && joint->column == column) continue;
      if (section.ring(id) == ContourSection::no_ring) add(id, column, row, beside);
      beside = section.ring(id);
    }
  while (joint != joints.end()) pass_joint();
  return id;
}

void ContourRings::follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row,
                          uint32_t beside, const Job* job) {
  const bool goes_up = grid_.inside(column, row);
  const uint32_t first = count();
  const bool is_inner = go_around(section,
                                  {cell_at(column, goes_up ? row : row - 1), id,
                                   goes_up ? cell_sides::top : cell_sides::bottom},
                                  id, nullptr, job);
  rings_.push_back({first, count(), beside, goes_up, true, is_inner});
}

void ContourRings::follow_from_gap(ContourSection& section, const ContourGaps::Place& start,
                                   bool goes_up, uint32_t beside, const Job* job) {
  const uint32_t first = count();
  const bool is_inner = go_around(section, {}, none, &start, job);
  rings_.push_back({first, count(), beside, goes_up, true, is_inner});
}

bool ContourRings::go_around(ContourSection& section, RingPlace place, uint32_t first,
                             const ContourGaps::Place* start, const Job* job) {
  const uint32_t number = next_number(), ring_first = count_;
  uint64_t inner_bits = 0;
  constexpr uint32_t poll_interval = 1024;
  if (start && !go_through(section, *start, start, place, job)) return true;
  do {
    make_room();
    count_ = follow_ring(
        {section, steps_, inner_cells(grid_), section.rings(), memory_->ends.data(),
         memory_->cells.data(), memory_->kinds.data(), gaps_.is_empty() ? nullptr : gaps_.bits()},
        number, first, count_, std::min(room_, count_ + poll_interval), place, inner_bits);
    check_cancelled(job);
    if ((place.crossing == first && count_ > ring_first) || !gaps_.holds(place.cell)) continue;
    make_room();
    const uint8_t kind = section.is_horizontal(place.crossing) ? ring_kind::horizontal : 0;
    if (kind) section.rings()[place.crossing] = number;
    put_crossing(
        section.ends()[place.crossing], place.cell,
        kind | ring_kind::saddle | (place.side >= cell_sides::top ? ring_kind::first_inside : 0));
    if (!go_through(section, gaps_.enter(gaps_.cell_at(place.cell), place.side), start, place, job))
      return InnerCells::are_inner(inner_bits);
  } while (place.crossing != first);
  return InnerCells::are_inner(inner_bits);
}

bool ContourRings::go_through(const ContourSection& section, ContourGaps::Place at,
                              const ContourGaps::Place* start, RingPlace& place, const Job* job) {
  const uint32_t number = next_number();
  bool is_first = start && at == *start;
  CancelPoll poll(job);
  while (is_first || gaps_.step(at)) {
    poll();
    if (!is_first && start && at == *start) return false;
    is_first = false;
    GapCrossing crossing = gaps_.crossing_before(at);
    crossing.id = count_;
    gap_crossings_.push_back(crossing);
    if (uint32_t* const ring = gaps_.ring_before(at)) *ring = number;
    make_room();
    put_crossing(0, gaps_.place_of(at.cell),
                 ring_kind::fine | (gaps_.is_saddle(at) ? ring_kind::saddle : 0) |
                     (crossing.is_horizontal ? ring_kind::horizontal : 0) |
                     (crossing.starts_inside ? ring_kind::first_inside : 0));
  }
  using namespace cell_sides;
  const uint64_t cell = gaps_.place_of(at.cell);
  const uint32_t column = column_of(cell), row = row_of(cell);
  const uint32_t id = section.crossing_of(at.side == bottom || at.side == top,
                                          column + (at.side == right), row + (at.side == top));
  constexpr uint64_t row_step = uint64_t{1} << 32;
  constexpr uint64_t to_cells[4] = {0 - row_step, 1, row_step, ~uint64_t{0}};
  place = {cell + to_cells[at.side], id, at.side};
  return true;
}

/// Adds a crossing in front of a divided cell, or within it.
void ContourRings::put_crossing(double end, uint64_t cell, int kind) {
  memory_->ends[count_] = end;
  memory_->cells[count_] = cell;
  memory_->kinds[count_] = static_cast<uint8_t>(kind);
  ++count_;
}

void ContourRings::make_room() {
  if (count_ < room_) return;
  room_ = most_;
  memory_->resize(room_ + max_simd_doubles);
}

/// Finds where the crossings of the rings lie.
void ContourRings::place(ContourPoints& points) {
  place_crossings({memory_->cells.data(), memory_->kinds.data(), count_}, nodes_,
                  memory_->ends.data(), memory_->x.data(), memory_->y.data());
  for (Ring& ring : rings_)
    if (!ring.is_inner) place_at_edges(ring);
  gaps_.locate(gap_crossings_, accuracy_, points, memory_->x.data(), memory_->y.data());
}

ContourRings::Edge ContourRings::edge_of(uint32_t i) const {
  uint32_t column = column_of(memory_->cells[i]), row = row_of(memory_->cells[i]);
  if (is_horizontal(i)) {
    if (!starts_inside(i)) ++row;  // it comes down
    return {column, row, 0};
  }
  if (starts_inside(i)) ++column;  // it comes from the right
  return {row, column, 1};
}

void ContourRings::place_at_edges(Ring& ring) {
  const InnerCells inner = inner_cells(grid_);
  for (uint32_t i = ring.first; i < ring.end; ++i) {
    if (InnerCells::are_inner(inner.bits(memory_->cells[i]))) continue;
    const Edge edge = edge_of(i);
    const Axis &along = axes_[edge.axis], &across = axes_[edge.axis ^ 1];
    const double low = along.at(edge.along), high = along.at(edge.along + 1);
    if (across.is_edge(edge.across)) memory_->kinds[i] |= ring_kind::seam;
    if (along.is_beyond(edge.along)) memory_->kinds[i] |= ring_kind::beyond;
    const double end = starts_inside(i) ? -memory_->ends[i] : memory_->ends[i];
    const double place =
        is_beyond(i) ? low : std::min(std::max(end, low + margin_), high - margin_);
    const double line = across.at(edge.across);
    memory_->x[i] = edge.axis == 0 ? place : line;
    memory_->y[i] = edge.axis == 0 ? line : place;
    ring.is_closed = ring.is_closed && !is_beyond(i);
  }
}

void ContourRings::find_gates(const Ring& ring, double tolerance, Vec2* at, LineGate* gates) const {
  const size_t first = ring.first, count = ring.end - ring.first;
  msq::find_gates({memory_->cells.data() + first, memory_->kinds.data() + first, count}, nodes_,
                  memory_->x.data() + first, memory_->y.data() + first, tolerance, at, gates);
  for (auto c = gap_crossing_from(ring.first); c != gap_crossings_.end() && c->id < ring.end; ++c)
    gates[c->id - ring.first] = gaps_.gate(*c, this->at(c->id), tolerance);
  if (ring.is_inner) return;
  const InnerCells inner = inner_cells(grid_);
  for (uint32_t i = ring.first; i < ring.end; ++i) {
    if (InnerCells::are_inner(inner.bits(memory_->cells[i]))) continue;
    const Edge edge = edge_of(i);
    const Axis& along = axes_[edge.axis];
    const double middle = edge.axis == 0 ? memory_->x[i] : memory_->y[i];
    const double low = std::max(middle - tolerance, along.at(edge.along) + margin_);
    const double high = std::min(middle + tolerance, along.at(edge.along + 1) - margin_);
    const double left = starts_inside(i) ? low : high, right = starts_inside(i) ? high : low;
    gates[i - ring.first] = edge.axis == 0 ? LineGate{left, right, memory_->y[i], memory_->y[i]}
                                           : LineGate{memory_->x[i], memory_->x[i], left, right};
  }
}

/// The first crossing between finer nodes that is not before one.
std::vector<GapCrossing>::const_iterator ContourRings::gap_crossing_from(uint32_t id) const {
  return std::lower_bound(gap_crossings_.begin(), gap_crossings_.end(), id,
                          [](const GapCrossing& g, uint32_t i) { return g.id < i; });
}

ContourRings::Cell ContourRings::cell_of(uint32_t i) const {
  if (is_fine(i)) {
    Cell part;
    gaps_.part_behind(*gap_crossing_from(i), part.low, part.high);
    return part;
  }
  const uint32_t column = column_of(memory_->cells[i]), row = row_of(memory_->cells[i]);
  return {{grid_.u(column), grid_.v(row)}, {grid_.u(column + 1), grid_.v(row + 1)}};
}

}  // namespace msq
