// SPDX-License-Identifier: Apache-2.0
#include "structure/common/plane_cells.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/status.h"

namespace msq {

namespace {

Box3 box_in_grid(const Neighbourhood& grid, const WallSection& section) {
  const Box2& w = section.window;
  return grid.to_grid(Box3{{w.min.x, w.min.y, section.z}, {w.max.x, w.max.y, section.z}});
}

}  // namespace

void require_in_cells(const Neighbourhood& grid, const WallSection& section) {
  const Box3 box = box_in_grid(grid, section);
  require_in_cells(grid, {box.min - grid.cell_size, box.max + grid.cell_size});
}

void require_finite_cells(const Neighbourhood& grid, const WallSection& section) {
  const Box3 box = box_in_grid(grid, section);
  bool are_finite = true;
  for (int axis = 0; axis < 3; ++axis)
    are_finite &= std::isfinite(box.min[axis] / grid.cell_size[axis]) &&
                  std::isfinite(box.max[axis] / grid.cell_size[axis]);
  if (are_finite) return;
  const Box2& w = section.window;
  const Vec3 o = grid.origin;
  fail(Status::limit,
       "the section from (%g, %g) to (%g, %g) at z %g is too far from the grid's origin (%g, %g, "
       "%g); the limit is %g cells",
       w.min.x, w.min.y, w.max.x, w.max.y, section.z, o.x, o.y, o.z, max_cell_index);
}

void require_in_cells(const Neighbourhood& grid, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis] / grid.cell_size[axis],
                 high = box.max[axis] / grid.cell_size[axis];
    if (!(low > -max_cell_index && high < max_cell_index))
      fail(Status::limit,
           "the section reaches from cell %g to cell %g along axis %d; the limit is %g cells from "
           "the grid's origin",
           std::floor(low), std::floor(high), axis, max_cell_index);
  }
}

CellRow cells_in_row(const GridMap& map, Vec3 cell_size, const Box3& box, double slack,
                     double cell_y, double cell_z) {
  double first = -infinity, last = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double* const m = map.m.data() + 3 * axis;
    // The image of a point of the row is `at` + `slope` * (cells along the row), give or take
    // `half`.
    const double along_y = m[1] * cell_size.y, along_z = m[2] * cell_size.z;
    const double at = map.origin[axis] + along_y * (cell_y + 0.5) + along_z * (cell_z + 0.5);
    const double half = 0.5 * (std::abs(along_y) + std::abs(along_z)) + slack;
    const double slope = m[0] * cell_size.x;
    const double from = box.min[axis] - half - at, to = box.max[axis] + half - at;
    if (slope == 0) {
      if (from > 0 || to < 0) return {0, -1};
      continue;
    }
    first = std::max(first, std::min(from / slope, to / slope));
    last = std::min(last, std::max(from / slope, to / slope));
  }
  return {std::floor(first), std::floor(last)};
}

}  // namespace msq
