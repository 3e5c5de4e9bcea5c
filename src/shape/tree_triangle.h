// SPDX-License-Identifier: Apache-2.0
// A triangle, and the definition of the distance to it in double precision. triangle_search.cpp has
// the same expressions for several triangles at a time.
#pragma once

#include <limits>

#include "base/vec.h"
#include "strut/segment.h"

namespace msq {

/// The corner a, and the vectors from it to the other two.
struct TreeTriangle {
  Vec3 a, u, v;

  TreeTriangle() = default;
  TreeTriangle(Vec3 a, Vec3 b, Vec3 c) : a(a), u(b - a), v(c - a) {}

  Segment edge_u() const { return {a, a + u}; }
  Segment edge_v() const { return {a, a + v}; }
  Segment edge_w() const { return {a + u, a + v}; }
  double longest_squared() const {
    const Vec3 w = v - u;
    return std::max({dot(u, u), dot(v, v), dot(w, w)});
  }
  /// One over the square of cross(u, v). 0 if the triangle is so flat that its normal is
  /// meaningless: its height is below 2^-24 of its longest edge.
  double inverse_normal_squared() const {
    const Vec3 normal = cross(u, v);
    const double squared = dot(normal, normal), longest = longest_squared();
    return squared <= 0x1p-48 * longest * longest ? 0 : 1 / squared;
  }

  /// Squared distance to the nearest point of the triangle, except for rounding: the foot of the
  /// perpendicular if it lies within, otherwise a point on one of the edges that the foot lies
  /// beyond. The distance is that of a point of the triangle, so its error is positive beyond
  /// rounding.
  double distance_squared(Vec3 p) const {
    const double inverse = inverse_normal_squared();
    bool beyond_u = true, beyond_v = true, beyond_w = true;
    if (inverse > 0) {
      const Vec3 normal = cross(u, v), w = p - a;
      const double of_u = dot(cross(w, v), normal) * inverse;
      const double of_v = dot(cross(u, w), normal) * inverse;
      beyond_u = of_v < 0;
      beyond_v = of_u < 0;
      beyond_w = of_u + of_v > 1;
      if (!(beyond_u || beyond_v || beyond_w)) {
        const Vec3 d = w - u * of_u - v * of_v;
        return dot(d, d);
      }
    }
    double least = std::numeric_limits<double>::infinity();
    if (beyond_u) least = std::min(least, edge_u().distance_squared(p));
    if (beyond_v) least = std::min(least, edge_v().distance_squared(p));
    if (beyond_w) least = std::min(least, edge_w().distance_squared(p));
    return least;
  }
};

}  // namespace msq
