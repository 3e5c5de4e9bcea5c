// SPDX-License-Identifier: Apache-2.0
// Converts between rays of hosts and cameras, with directions of any length, and those of the
// caster.
#pragma once

#include <cmath>
#include <limits>

#include "ray/cast.h"

namespace msq {

/// Length of a direction, also if its square overflows or underflows.
inline double size_of(Vec3 d) {
  return std::hypot(d.x, d.y, d.z);
}

/// Sets up a search for from <= t <= to along origin + t * direction; `size` is the length of the
/// direction. It is built in place: a copy would wait for the numbers just written.
inline void search_along(Vec3 origin, Vec3 direction, double size, double from, double to,
                         RaySearch& search) {
  search.ray.origin = origin;
  search.ray.direction = {direction.x / size, direction.y / size, direction.z / size};
  search.from = from * size;
  search.to = to * size;
}

/// t of the hit; infinity if and only if there is no hit.
inline double parameter_of(const RayHit& hit, double size, double from, double to) {
  return hit.scale < 0 ? std::numeric_limits<double>::infinity()
         : hit.starts_inside
             ? from
             : std::min(hit.t / size, std::min(to, std::numeric_limits<double>::max()));
}

}  // namespace msq
