// SPDX-License-Identifier: Apache-2.0
// Boxes along the axes of the samples in a grid that may be turned against them. The box along the
// grid's axes around such a box meets several times as many cells if the grid is turned and its
// cells are small, so it must not be used to count or to collect cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cell/neighbourhood.h"

namespace msq {

/// The number of cells that a box in model coordinates meets, on average over all places of the
/// grid: the volume of the sum of the box and a cell, in cells. Both are parallelepipeds, so their
/// sum is a zonotope. Its volume is the sum of the volumes that any three of its six generators
/// span (Shephard, "Combinatorial properties of associated zonotopes", 1974). If the grid is not
/// turned, that is the product of 1 + extent / cell size over the axes.
inline double mean_cells_met(const Neighbourhood& grid, const Box3& box) {
  const Vec3 extent = box.extent(), size = grid.cell_size;
  Vec3 generators[6];
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along[axis] = extent[axis];
    const Vec3 in_grid = grid.rotation.apply_inverse(along);
    generators[axis] = {in_grid.x / size.x, in_grid.y / size.y, in_grid.z / size.z};
    generators[axis + 3] = {};
    generators[axis + 3][axis] = 1;
  }
  double cells = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      for (int k = j + 1; k < 6; ++k)
        cells += std::abs(dot(generators[i], cross(generators[j], generators[k])));
  return cells;
}

/// Calls visit(corner, part) for each brick of side^3 cells that has points within `around`, and
/// `beyond` along the grid's axes, of a box in model coordinates, and for few others. Bricks begin
/// `lead` cells before multiples of `side`; corner: their first cell. part: a box in grid
/// coordinates that contains the points of the box as near as that to the brick.
template <class Visit>
void for_each_brick_near(const Neighbourhood& grid, const Box3& box, double around, Vec3 beyond,
                         int side, int lead, Visit&& visit) {
  const Box3 whole = grid.to_grid(box);
  const bool is_turned = grid.sample_axes()[0] < 0;
  int64_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto brick = [&](double g) {
      return static_cast<int64_t>(std::floor((g / grid.cell_size[axis] + lead) / side));
    };
    first[axis] = brick(whole.min[axis] - around - beyond[axis]);
    last[axis] = brick(whole.max[axis] + around + beyond[axis]);
  }
  for (int64_t k = first[2]; k <= last[2]; ++k)
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (int64_t i = first[0]; i <= last[0]; ++i) {
        const CellIndex corner{static_cast<int32_t>(i * side - lead),
                               static_cast<int32_t>(j * side - lead),
                               static_cast<int32_t>(k * side - lead)};
        if (!is_turned) {
          visit(corner, whole);
          continue;
        }
        const Vec3 low =
            Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid.cell_size;
        const Box3 brick = {low - beyond, low + grid.cell_size * double(side) + beyond};
        const Box3 reach = grid.from_grid(brick).grown(around);
        if (!reach.overlaps(box)) continue;
        const Box3 part = grid.to_grid(Box3{max(reach.min, box.min), min(reach.max, box.max)});
        visit(corner, Box3{max(part.min, whole.min), min(part.max, whole.max)});
      }
}

template <class Visit>
void for_each_brick_near(const Neighbourhood& grid, const Box3& box, double around, int side,
                         int lead, Visit&& visit) {
  for_each_brick_near(grid, box, around, Vec3{}, side, lead, visit);
}

}  // namespace msq
