// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/graded_places.h"

#include <algorithm>
#include <cmath>

namespace msq {

GradedPlaces::GradedPlaces(const Neighbourhood& grid, GradedPeriod period)
    : smallest_(period.resized(grid, period.smallest())), period_(std::move(period)) {}

double GradedPlaces::largest() const {
  return max_component(period_.resized(smallest_, period_.largest()).cell_size);
}

CellIndex GradedPlaces::cell_of(Vec3 g) const {
  int32_t cell[3];
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = static_cast<int32_t>(std::floor(
        axis == period_.axis() ? period_.cells(g[axis]) : g[axis] / smallest_.cell_size[axis]));
  return {cell[0], cell[1], cell[2]};
}

Vec3 GradedPlaces::place(CellIndex cell, Vec3 fraction) const {
  const Vec3 u = Vec3{double(cell.x), double(cell.y), double(cell.z)} + fraction;
  Vec3 g = u * smallest_.cell_size;
  g[period_.axis()] = period_.position_of(u[period_.axis()]);
  return g;
}

Box3 GradedPlaces::bounds(const CellBlock& cells) const {
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = cells.first[axis], high = cells.last[axis] + 1, slack = 0;
    if (axis == period_.axis()) {
      slack = 4 * std::max(period_.error(low), period_.error(high)) * period_.largest();
      low = period_.position_of(low);
      high = period_.position_of(high);
    } else {
      low *= smallest_.cell_size[axis];
      high *= smallest_.cell_size[axis];
    }
    // The error of positions is a few units of 2^-53 of the largest magnitude.
    slack += 0x1p-48 * (std::abs(low) + std::abs(high));
    box.min[axis] = low - slack;
    box.max[axis] = high + slack;
  }
  return box;
}

void GradedPlaces::for_each_block(const Box3& box, const TakeBlock& take) const {
  CellBlock cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto place_of = [&](double g) {
      return axis == period_.axis() ? period_.cells(g) : g / smallest_.cell_size[axis];
    };
    const double low = place_of(box.min[axis]), high = place_of(box.max[axis]);
    // The corners of cells are rounded too. Along a graded axis, relative to the largest cells.
    const double slack = axis == period_.axis()
                             ? 1e-6 + 16 * std::max(period_.error(low), period_.error(high)) *
                                          period_.largest() / period_.smallest()
                             : 1e-6;
    cells.first[axis] = cell_within_reach(low - slack);
    cells.last[axis] = cell_within_reach(high + slack);
  }
  take(cells);
}

}  // namespace msq
