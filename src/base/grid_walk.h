// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/ray.h"

namespace msq {

/// Cells farther from the origin than this along an axis are not distinguished.
constexpr double max_walked_index = 0x1p52;

/// The index of the cell that contains a coordinate; an arbitrary index for NaN.
inline int64_t walked_index(double coordinate, double size) {
  const double index = std::floor(coordinate / size);
  if (!(index > -max_walked_index)) return -static_cast<int64_t>(max_walked_index);
  return static_cast<int64_t>(std::min(index, max_walked_index));
}

/// Calls visit(index, from, to) for each grid cell that a ray crosses in [from, to], with the part
/// of the ray in that cell, until visit returns false. The ray is in the grid's frame. `start` is
/// its point at `from`, and end() returns that at `to`. Stops early, by Error(cancelled), with the
/// job.
/// Source: Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", 1987. Each
/// crossing is computed from its plane, so that errors do not add up.
///
/// Rounding may put a crossing and the cells of start and end on different sides of a plane. So the
/// steps along each axis are at most two more than the difference of the two cells' indices. Most
/// rays end sooner, so that difference is computed after as many steps as all rays may take.
template <class End, class Visit>
void walk_grid(const Ray& ray, Vec3 start, End&& end, Vec3 size, double from, double to,
               const Job* job, Visit&& visit) {
  const Vec3 along = ray.direction;
  int64_t index[3];
  double next[3];
  const auto crossing = [&](int axis) {
    const double plane = static_cast<double>(index[axis] + (along[axis] > 0)) * size[axis];
    return along[axis] == 0 ? std::numeric_limits<double>::infinity()
                            : (plane - ray.origin[axis]) / along[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    index[axis] = walked_index(start[axis], size[axis]);
    next[axis] = crossing(axis);
  }
  const auto difference = [&] {
    const Vec3 last = end();
    int64_t cells = 0;
    for (int axis = 0; axis < 3; ++axis)
      cells +=
          std::abs(walked_index(last[axis], size[axis]) - walked_index(start[axis], size[axis]));
    return cells;
  };
  int64_t steps = 3 * 2;
  bool knows_end = false;
  JobPoll poll(job);
  for (;; --steps) {
    if (steps < 0) {
      if (knows_end) return;
      knows_end = true;
      steps += difference();
      if (steps < 0) return;
    }
    poll();
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double until = std::max(from, std::min(next[axis], to));
    const int64_t(&cell)[3] = index;
    if (!visit(cell, from, until) || next[axis] >= to) return;
    from = until;
    index[axis] += along[axis] > 0 ? 1 : -1;
    next[axis] = crossing(axis);
  }
}

}  // namespace msq
