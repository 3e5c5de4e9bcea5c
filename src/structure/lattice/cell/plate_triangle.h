// SPDX-License-Identifier: Apache-2.0
// The middle of a plate. A plate is the set of all points within half of its thickness of a
// triangle: two flat sides and a round rim.
#pragma once

#include "base/vec.h"
#include "strut/segment.h"

namespace msq {

struct PlateTriangle {
  /// From a to b, from b to c, from c to a.
  Segment edges[3];
  /// Of length 1.
  Vec3 normal;
  /// The point a + s ab + t ac plus a multiple of the normal has these products with it, less a.
  Vec3 to_s, to_t;

  PlateTriangle() = default;
  /// The corners must not be on a line.
  PlateTriangle(Vec3 a, Vec3 b, Vec3 c) : edges{{a, b}, {b, c}, {c, a}} {
    const Vec3 ab = b - a, ac = c - a, n = cross(ab, ac);
    const double inverse = 1 / dot(n, n);
    normal = n * std::sqrt(inverse);
    to_s = cross(ac, n) * inverse;
    to_t = cross(n, ab) * inverse;
  }

  Vec3 a() const { return edges[0].a; }
  Vec3 b() const { return edges[1].a; }
  Vec3 c() const { return edges[2].a; }

  /// Whether the nearest point of the plane is one of the triangle; w: from a.
  bool is_over(Vec3 w) const {
    const double s = dot(w, to_s), t = dot(w, to_t);
    return s >= 0 && t >= 0 && s + t <= 1;
  }
  /// The vector to a point from the nearest point of the triangle.
  Vec3 way_to(Vec3 p) const {
    const Vec3 w = p - edges[0].a;
    if (is_over(w)) return normal * dot(w, normal);
    Vec3 way = edges[0].way_to(p);
    for (int edge = 1; edge < 3; ++edge) {
      const Vec3 other = edges[edge].way_to(p);
      if (dot(other, other) < dot(way, way)) way = other;
    }
    return way;
  }
  /// Squared distance of a point; this expression is the definition of plate membership.
  double distance_squared(Vec3 p) const {
    const Vec3 w = p - edges[0].a;
    if (is_over(w)) {
      const double height = dot(w, normal);
      return height * height;
    }
    return std::min(
        {edges[0].distance_squared(p), edges[1].distance_squared(p), edges[2].distance_squared(p)});
  }
  /// Bound on the error of distances to points within `reach` of the corners: that of the normal
  /// grows as the triangle becomes narrow.
  double error(double reach) const {
    const double longest = std::max({dot(edges[0].ab, edges[0].ab), dot(edges[1].ab, edges[1].ab),
                                     dot(edges[2].ab, edges[2].ab)});
    const double area = length(cross(edges[0].ab, edges[2].ab));
    return 0x1p-48 * (longest / area) * reach;
  }
};

inline Box3 bounds_of(const PlateTriangle& t) {
  return {min(t.a(), min(t.b(), t.c())), max(t.a(), max(t.b(), t.c()))};
}

}  // namespace msq
