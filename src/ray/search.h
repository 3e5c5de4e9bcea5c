// SPDX-License-Identifier: Apache-2.0
// Rays as hosts and cameras have them, along directions of any length, and as the caster does.
#pragma once

#include <cmath>
#include <limits>

#include "ray/cast.h"

namespace msq {

/// Length of a direction, also where its square overflows or vanishes.
inline double size_of(Vec3 d) {
  return std::hypot(d.x, d.y, d.z);
}

/// Makes a new search that at from <= t <= to along origin + t * direction, a direction of this
/// size. In place: a copy of numbers just written waits for them.
inline void search_along(Vec3 origin, Vec3 direction, double size, double from, double to,
                         RaySearch& search) {
  search.ray.origin = origin;
  search.ray.direction = {direction.x / size, direction.y / size, direction.z / size};
  search.from = from * size;
  search.to = to * size;
}

/// t of what it found, infinity where that is nothing.
inline double parameter_of(const RayHit& hit, double size, double from, double to) {
  return hit.scale < 0       ? std::numeric_limits<double>::infinity()
         : hit.starts_inside ? from
                             : std::min(hit.t / size, to);
}

}  // namespace msq
