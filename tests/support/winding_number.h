// SPDX-License-Identifier: Apache-2.0
// The generalised winding number as it is defined, and meshes with holes to take it of.
#pragma once

#include "base/triangle_soup.h"
#include "random.h"

namespace msq::test {

/// The solid angles of all triangles over 4 pi, in extended precision. Source: Van Oosterom and
/// Strackee, "The solid angle of a plane triangle", 1983.
inline double winding_number(const TriangleSoup& soup, Vec3 p) {
  struct Way {
    long double x, y, z;
  };
  const auto way = [&](uint32_t v) {
    const Vec3 a = soup.vertices[v];
    return Way{static_cast<long double>(a.x) - p.x, static_cast<long double>(a.y) - p.y,
               static_cast<long double>(a.z) - p.z};
  };
  const auto inner = [](Way a, Way b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  long double sum = 0;
  for (const Triangle& t : soup.triangles) {
    const Way a = way(t[0]), b = way(t[1]), c = way(t[2]);
    const long double of_a = std::sqrt(inner(a, a)), of_b = std::sqrt(inner(b, b)),
                      of_c = std::sqrt(inner(c, c));
    const Way across{b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
    sum += std::atan2(inner(a, across), of_a * of_b * of_c + inner(a, b) * of_c +
                                            inner(a, c) * of_b + inner(b, c) * of_a);
  }
  return static_cast<double>(sum / (2 * std::acos(-1.0L)));
}

/// Without a part of the triangles, chosen at random.
inline TriangleSoup with_holes(TriangleSoup soup, double part, uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> kept;
  for (const Triangle& t : soup.triangles)
    if (random.unit() >= part) kept.push_back(t);
  soup.triangles = kept;
  return soup;
}

/// Each triangle with vertices of its own, moved by up to `by` along each axis.
inline TriangleSoup torn(const TriangleSoup& soup, double by, uint64_t seed) {
  Random random(seed);
  TriangleSoup loose;
  for (const Triangle& t : soup.triangles) {
    const uint32_t first = static_cast<uint32_t>(loose.vertices.size());
    for (const uint32_t v : t)
      loose.vertices.push_back(soup.vertices[v] + random.in_box({{-by, -by, -by}, {by, by, by}}));
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  return loose;
}

}  // namespace msq::test
