// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_rings.h"

#include <algorithm>
#include <bit>

namespace msq {

namespace {

/// Rings lead through rows above their lowest one.
constexpr uint32_t rows_ahead = 16;
/// What is known of so many crossings stays in the core's cache while they are looked into.
constexpr uint32_t crossings_at_once = 1 << 14;

}  // namespace

ContourRings::ContourRings(const ContourSection& section)
    : grid_(section.grid()),
      axes_{{grid_.u_nodes().first(), grid_.pitch(), grid_.u_nodes().low(), grid_.u_nodes().high(),
             ContourGrid::first_inner, ContourGrid::left_beyond, ContourGrid::left_edge,
             grid_.right_edge()},
            {grid_.v_nodes().first(), grid_.pitch(), grid_.v_nodes().low(), grid_.v_nodes().high(),
             ContourGrid::first_inner_row, 0, ContourGrid::bottom_row, grid_.top_edge()}},
      margin_(section.margin()) {
  if (memory_->x.size() < section.count()) {
    memory_->x.resize(section.count());
    memory_->y.resize(section.count());
    memory_->edges.resize(section.count());
    memory_->kinds.resize(section.count());
  }
}

void ContourRings::follow_all(ContourSection& section, const Job* job,
                              const std::function<void()>& visit) {
  const EdgeCrossing* const crossings = section.crossings();
  uint32_t id = 0;
  for (uint32_t r = 0; r < grid_.rows(); ++r) {
    check_cancelled(job);
    section.prefetch(r + rows_ahead);
    const uint32_t row_start = id;
    for (size_t w = 0; w < grid_.row_words(); ++w)
      for (uint64_t rest = section.horizontal(r, w); rest; rest &= rest - 1, ++id) {
        if (crossings[id].way == ContourSection::visited) continue;
        const uint32_t column =
            static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest));
        // It is the leftmost crossing on the ring's lowest row, so what is to its left is around
        // the ring. The crossing before it on the row, if any, is of a ring that borders on the
        // same.
        const uint32_t beside = id > row_start ? crossings[id - 1].next : none;
        const uint32_t first = count();
        const bool is_closed = follow(section, id, column, r, job);
        rings_.push_back({first, count(), beside, grid_.inside(column, r), is_closed});
        if (count() < crossings_at_once) continue;
        visit();
        rings_before_ += static_cast<uint32_t>(rings_.size());
        rings_.clear();
        count_ = 0;
      }
  }
  visit();
}

bool ContourRings::follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row,
                          const Job* job) {
  // By the side of the cell that the boundary leaves: the edge relative to the cell, its kind, and
  // the way to the next cell. The inside is on the left, so it goes up and to the left where the
  // edge's first node is inside.
  struct Step {
    uint8_t kind, right, up;
    int8_t next_right, next_up;
  };
  constexpr Step steps[4] = {{horizontal, 0, 0, 0, -1},
                             {0, 1, 0, 1, 0},
                             {horizontal | first_inside, 0, 1, 0, 1},
                             {first_inside, 0, 0, -1, 0}};
  const uint32_t number = rings_before_ + static_cast<uint32_t>(rings_.size());
  EdgeCrossing* const crossings = section.crossings();
  const double* const ends = section.ends();
  double* const x = memory_->x.data();
  double* const y = memory_->y.data();
  RingEdge* const edges = memory_->edges.data();
  uint8_t* const out_kinds = memory_->kinds.data();
  const bool goes_up = grid_.inside(column, row);
  uint8_t kind = goes_up ? horizontal | first_inside : horizontal;
  uint8_t kinds = 0;
  uint32_t cell_column = column, cell_row = goes_up ? row : row - 1;
  uint32_t n = count_;
  CancelPoll poll(job);
  for (;; ++n) {
    poll();
    EdgeCrossing& c = crossings[id];
    const uint32_t way = c.way;
    if (way == ContourSection::visited) break;
    // Horizontal and vertical edges alternate in no order: indices instead of branches.
    const uint32_t place[2] = {column, row};
    const uint32_t along = ~kind & horizontal, across = along ^ 1;
    const Axis &a = axes_[along], &b = axes_[across];
    const uint32_t at_along = place[along], at_across = place[across];
    double low, high, line;
    if (a.are_inner(at_along) && b.are_inner(at_across)) {
      low = a.inner_at(at_along);
      high = a.inner_at(at_along + 1);
      line = b.inner_at(at_across);
    } else {
      low = a.at(at_along);
      high = a.at(at_along + 1);
      line = b.at(at_across);
      if (b.is_edge(at_across)) kind |= seam;
      if (a.is_beyond(at_along)) kind |= beyond;
    }
    const uint64_t sign = static_cast<uint64_t>(kind & first_inside) << (63 - first_inside_bit);
    const double end = std::bit_cast<double>(std::bit_cast<uint64_t>(ends[id]) ^ sign);
    double at[2];
    at[across] = line;
    at[along] = kind & beyond ? low : std::min(std::max(end, low + margin_), high - margin_);
    if (ContourSection::enters_saddle(way)) kind |= saddle;
    kinds |= kind;
    x[n] = at[0];
    y[n] = at[1];
    edges[n] = {column, row};
    out_kinds[n] = kind;
    const Step& step = steps[static_cast<size_t>(ContourSection::side_of(way))];
    id = c.next;
    c = {number, ContourSection::visited};
    kind = step.kind;
    column = cell_column + step.right;
    row = cell_row + step.up;
    cell_column += static_cast<uint32_t>(static_cast<int32_t>(step.next_right));
    cell_row += static_cast<uint32_t>(static_cast<int32_t>(step.next_up));
  }
  count_ = n;
  return !(kinds & beyond);
}

ContourRings::Cell ContourRings::cell_of(uint32_t i) const {
  uint32_t column = memory_->edges[i].column, row = memory_->edges[i].row;
  if (is_horizontal(i) && !starts_inside(i)) --row;     // it comes down
  if (!is_horizontal(i) && starts_inside(i)) --column;  // it comes from the right
  return {{grid_.u(column), grid_.v(row)}, {grid_.u(column + 1), grid_.v(row + 1)}};
}

}  // namespace msq
