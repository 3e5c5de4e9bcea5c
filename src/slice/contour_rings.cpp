// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_rings.h"

#include <bit>

namespace msq {

ContourRings::ContourRings(ContourSection& section, const Job* job)
    : grid_(section.grid()), margin_(section.margin()) {
  memory_->crossings.clear();
  memory_->kinds.clear();
  memory_->crossings.reserve(section.count());
  memory_->kinds.reserve(section.count());
  const EdgeCrossing* const crossings = section.crossings();
  uint32_t id = 0;
  for (uint32_t r = 0; r < grid_.rows(); ++r) {
    check_cancelled(job);
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
      }
  }
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
  const uint32_t number = static_cast<uint32_t>(rings_.size());
  EdgeCrossing* const crossings = section.crossings();
  const uint32_t bottom_edge = grid_.bottom_edge(), top_edge = grid_.top_edge();
  const uint32_t left_edge = ContourGrid::left_edge, right_edge = grid_.right_edge();
  const bool goes_up = grid_.inside(column, row);
  uint8_t kind = goes_up ? horizontal | first_inside : horizontal;
  uint8_t kinds = 0;
  uint32_t cell_column = column, cell_row = goes_up ? row : row - 1;
  CancelPoll poll(job);
  for (;;) {
    poll();
    EdgeCrossing& c = crossings[id];
    if (c.way == ContourSection::visited) break;
    const bool is_horizontal = kind & horizontal;
    const bool is_on_seam = is_horizontal ? row == bottom_edge || row == top_edge
                                          : column == left_edge || column == right_edge;
    if (is_on_seam) kind |= seam;
    if (grid_.is_beyond(is_horizontal, column, row)) kind |= beyond;
    if (ContourSection::enters_saddle(c.way)) kind |= saddle;
    kinds |= kind;
    memory_->crossings.push_back(
        {is_horizontal ? Vec2{c.at, grid_.v(row)} : Vec2{grid_.u(column), c.at}, column, row});
    memory_->kinds.push_back(kind);
    const Step& step = steps[static_cast<size_t>(ContourSection::side_of(c.way))];
    id = c.next;
    c.next = number;
    c.way = ContourSection::visited;
    kind = step.kind;
    column = cell_column + step.right;
    row = cell_row + step.up;
    cell_column += static_cast<uint32_t>(static_cast<int32_t>(step.next_right));
    cell_row += static_cast<uint32_t>(static_cast<int32_t>(step.next_up));
  }
  return !(kinds & beyond);
}

ContourRings::Cell ContourRings::cell_of(uint32_t i) const {
  uint32_t column = memory_->crossings[i].column, row = memory_->crossings[i].row;
  if (is_horizontal(i) && !starts_inside(i)) --row;     // it comes down
  if (!is_horizontal(i) && starts_inside(i)) --column;  // it comes from the right
  return {{grid_.u(column), grid_.v(row)}, {grid_.u(column + 1), grid_.v(row + 1)}};
}

}  // namespace msq
