// SPDX-License-Identifier: Apache-2.0
// The axis of a strut. A strut is the capsule of all points within a radius of its axis.
#pragma once

#include "base/vec.h"

namespace msq {

struct Segment {
  Vec3 a;
  Vec3 ab;
  double inverse_length_squared = 0;  ///< 0 for a segment that is a point

  Segment() = default;
  Segment(Vec3 a, Vec3 b) : a(a), ab(b - a) {
    const double l2 = dot(ab, ab);
    inverse_length_squared = l2 > 0 ? 1 / l2 : 0;
  }

  /// The vector to a point from the nearest point of the segment.
  Vec3 way_to(Vec3 p) const {
    const Vec3 w = p - a;
    const double t = std::clamp(dot(w, ab) * inverse_length_squared, 0.0, 1.0);
    return w - ab * t;
  }
  /// Squared distance of a point; this expression is the definition of strut membership.
  double distance_squared(Vec3 p) const {
    const Vec3 d = way_to(p);
    return dot(d, d);
  }
};

}  // namespace msq
