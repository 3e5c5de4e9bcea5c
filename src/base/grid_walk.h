// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/ray.h"

namespace msq {

/// Calls visit(index, from, to) for the cells of a grid that a ray, in the grid's frame, crosses in
/// [from, to], and for where it does: until that answers false. `start`: the ray's point at `from`.
/// Source: Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", 1987; each
/// crossing from its plane, so that nothing adds up.
template <class Visit>
void walk_grid(const Ray& ray, Vec3 start, Vec3 size, double from, double to, Visit&& visit) {
  const Vec3 along = ray.direction;
  int64_t index[3];
  double next[3];
  const auto crossing = [&](int axis) {
    const double plane = static_cast<double>(index[axis] + (along[axis] > 0)) * size[axis];
    return along[axis] == 0 ? std::numeric_limits<double>::infinity()
                            : (plane - ray.origin[axis]) / along[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    index[axis] = static_cast<int64_t>(std::floor(start[axis] / size[axis]));
    next[axis] = crossing(axis);
  }
  while (true) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double end = std::max(from, std::min(next[axis], to));
    const int64_t(&cell)[3] = index;
    if (!visit(cell, from, end) || next[axis] >= to) return;
    from = end;
    index[axis] += along[axis] > 0 ? 1 : -1;
    next[axis] = crossing(axis);
  }
}

}  // namespace msq
