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

ContourRings::ContourRings(const ContourSection& section, bool has_struts)
    : grid_(section.grid()),
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
      room_(std::min(section.count(), first_room)) {
  if (memory_->x.size() < room_ + max_simd_doubles) memory_->resize(room_ + max_simd_doubles);
  room_ = static_cast<uint32_t>(
      std::min<size_t>(section.count(), memory_->x.size() - max_simd_doubles));
}

uint64_t ContourRings::bytes(uint64_t crossings) {
  constexpr uint64_t bytes_of_crossing = 3 * sizeof(double) + sizeof(uint64_t) + sizeof(uint8_t);
  // Where there is no room for a ring, it is copied to where there is.
  return (crossings + std::min<uint64_t>(crossings, first_room) + 2 * max_simd_doubles) *
         bytes_of_crossing;
}

void ContourRings::follow_all(ContourSection& section, const Job* job,
                              const std::function<void()>& visit) {
  const uint32_t* const rings = section.rings();
  uint32_t id = 0;
  for (uint32_t r = 0; r < grid_.rows(); ++r) {
    check_cancelled(job);
    section.prefetch(r + rows_ahead);
    const uint32_t row_start = id;
    for (size_t w = 0; w < grid_.row_words(); ++w)
      for (uint64_t rest = section.horizontal(r, w); rest; rest &= rest - 1, ++id) {
        if (rings[id] != ContourSection::no_ring) continue;
        const uint32_t column =
            static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest));
        // It is the leftmost crossing on the ring's lowest row, so what is to its left is around
        // the ring. The crossing before it on the row, if any, is of a ring that borders on the
        // same.
        const uint32_t beside = id > row_start ? rings[id - 1] : none;
        const uint32_t first = count();
        const bool is_inner = follow(section, id, column, r, job);
        rings_.push_back({first, count(), beside, grid_.inside(column, r), true, is_inner});
        if (count() < at_once_) continue;
        place();
        visit();
        rings_before_ += static_cast<uint32_t>(rings_.size());
        rings_.clear();
        count_ = 0;
      }
  }
  place();
  visit();
}

bool ContourRings::follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row,
                          const Job* job) {
  const uint32_t number = rings_before_ + static_cast<uint32_t>(rings_.size());
  const bool goes_up = grid_.inside(column, row);
  RingPlace place{cell_at(column, goes_up ? row : row - 1), id,
                  goes_up ? cell_sides::top : cell_sides::bottom};
  uint64_t inner_bits = 0;
  constexpr uint32_t poll_interval = 1024;
  do {
    if (count_ == room_) {
      room_ = section.count();
      memory_->resize(room_ + max_simd_doubles);
    }
    count_ =
        follow_ring({section, steps_, inner_cells(grid_), section.rings(), memory_->ends.data(),
                     memory_->cells.data(), memory_->kinds.data()},
                    number, id, count_, std::min(room_, count_ + poll_interval), place, inner_bits);
    check_cancelled(job);
  } while (place.crossing != id);
  return InnerCells::are_inner(inner_bits);
}

/// Finds where the crossings of the rings lie.
void ContourRings::place() {
  place_crossings({memory_->cells.data(), memory_->kinds.data(), count_}, nodes_,
                  memory_->ends.data(), memory_->x.data(), memory_->y.data());
  for (Ring& ring : rings_)
    if (!ring.is_inner) place_at_edges(ring);
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

ContourRings::Cell ContourRings::cell_of(uint32_t i) const {
  const uint32_t column = column_of(memory_->cells[i]), row = row_of(memory_->cells[i]);
  return {{grid_.u(column), grid_.v(row)}, {grid_.u(column + 1), grid_.v(row + 1)}};
}

}  // namespace msq
