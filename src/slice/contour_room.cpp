// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_room.h"

#include <algorithm>

namespace msq {

ContourRoom::Beside ContourRoom::beside(uint32_t id, int axis, bool is_high) const {
  if (rings_.is_fine(id)) return {};
  const ContourGrid& grid = rings_.grid();
  const uint64_t step = axis == 0 ? 1 : uint64_t{1} << 32;
  const uint64_t own = rings_.place_of_cell(id), place = is_high ? own + step : own - step;
  const uint32_t column = static_cast<uint32_t>(place), row = static_cast<uint32_t>(place >> 32);
  if (!grid.is_inner_cell(column, row) || rings_.gaps().holds(place)) return {};
  const bool is_inside = grid.inside(column, row);
  const bool are_alike = grid.inside(column + 1, row) == is_inside &&
                         grid.inside(column, row + 1) == is_inside &&
                         grid.inside(column + 1, row + 1) == is_inside;
  if (!are_alike || taken_.contains(place)) return {};
  return {.place = place, .axis = axis, .is_high = is_high};
}

ContourRoom::Cell ContourRoom::cells(uint32_t id, const Beside& beside) const {
  Cell cell = rings_.cell_of(id);
  if (beside.place == 0) return cell;
  const double pitch = rings_.grid().pitch();
  const Vec2 step = beside.axis == 0 ? Vec2{pitch, 0} : Vec2{0, pitch};
  if (beside.is_high)
    cell.high = cell.high + step;
  else
    cell.low = cell.low - step;
  return cell;
}

bool ContourRoom::holds(uint32_t id, const Beside& beside, Vec2 p) const {
  const double margin = rings_.margin();
  const Cell all = cells(id, beside);
  for (int i = 0; i < 2; ++i)
    if (!(p[i] >= all.low[i] + margin && p[i] <= all.high[i] - margin)) return false;
  if (beside.place == 0) return true;
  // Lines to the crossing's cell, whose ends keep the margin from the nodes between both cells, do
  // not come near these.
  const Cell own = rings_.cell_of(id);
  const int axis = beside.axis, along = 1 - axis;
  const double off = beside.is_high ? p[axis] - own.high[axis] : own.low[axis] - p[axis];
  const double to_nodes = std::min(p[along] - own.low[along], own.high[along] - p[along]);
  constexpr double steepest = 16;
  return steepest * to_nodes >= margin + off;
}

bool ContourRoom::take(const Beside& beside) {
  return beside.place == 0 || taken_.insert(beside.place).second;
}

}  // namespace msq
