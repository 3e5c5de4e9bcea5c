// SPDX-License-Identifier: Apache-2.0
// Source: Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975): every simple
// polygon has a vertex whose triangle with its neighbours can be cut off. Convex polygons, which
// are nearly all, are cut as fans in linear time. Ears take quadratic time, hence the limit.
//
// A polygon that is not simple or not flat still gives a surface with the same border, so closed
// meshes stay closed in any case.
#include "io/polygon.h"

#include <cstddef>

#include "base/status.h"

namespace msq {
namespace {

constexpr size_t max_concave = 4096;

struct Point {
  double u, v;
};

/// Twice the signed area of the triangle.
double area(Point a, Point b, Point c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// The polygon projected along the axis closest to its normal (Newell), counter-clockwise.
std::vector<Point> flatten(const std::vector<Vec3>& vertices, std::span<const uint32_t> polygon) {
  Vec3 normal;
  const Vec3 base = vertices[polygon[0]];
  for (size_t i = 1; i + 1 < polygon.size(); ++i)
    normal = normal + cross(vertices[polygon[i]] - base, vertices[polygon[i + 1]] - base);
  int axis = std::abs(normal.x) > std::abs(normal.y) ? 0 : 1;
  if (std::abs(normal.z) > std::abs(normal[axis])) axis = 2;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Point> points;
  points.reserve(polygon.size());
  for (const uint32_t index : polygon) {
    const Vec3 p = vertices[index] - base;
    points.push_back({p[(axis + 1) % 3], sign * p[(axis + 2) % 3]});
  }
  return points;
}

bool is_convex(const std::vector<Point>& points) {
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i)
    if (area(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  return true;
}

/// Whether vertex b of the ring can be cut off between its neighbours a and c.
bool is_ear(const std::vector<Point>& points, const std::vector<uint32_t>& ring, size_t a, size_t b,
            size_t c) {
  const Point p = points[ring[a]], q = points[ring[b]], r = points[ring[c]];
  if (!(area(p, q, r) > 0)) return false;
  for (size_t i = 0; i < ring.size(); ++i) {
    if (i == a || i == b || i == c) continue;
    const Point t = points[ring[i]];
    const bool is_corner =
        (t.u == p.u && t.v == p.v) || (t.u == q.u && t.v == q.v) || (t.u == r.u && t.v == r.v);
    if (!is_corner && area(p, q, t) >= 0 && area(q, r, t) >= 0 && area(r, p, t) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate_polygon(const std::vector<Vec3>& vertices, std::span<const uint32_t> polygon,
                         std::vector<Triangle>& triangles, const Job* job) {
  const auto fan = [&](const std::vector<uint32_t>& ring) {
    for (size_t i = 1; i + 1 < ring.size(); ++i)
      triangles.push_back({polygon[ring[0]], polygon[ring[i]], polygon[ring[i + 1]]});
  };
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  std::vector<uint32_t> ring(polygon.size());
  for (size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<uint32_t>(i);
  const std::vector<Point> points = flatten(vertices, polygon);
  if (is_convex(points)) return fan(ring);
  if (polygon.size() > max_concave)
    fail(Status::limit, "a concave polygon has %zu vertices; the limit is %zu", polygon.size(),
         max_concave);
  size_t tries = 0;
  for (size_t b = 1; ring.size() > 3 && tries < ring.size();) {
    check_cancelled(job);
    const size_t n = ring.size();
    b %= n;
    const size_t a = (b + n - 1) % n, c = (b + 1) % n;
    if (is_ear(points, ring, a, b, c)) {
      triangles.push_back({polygon[ring[a]], polygon[ring[b]], polygon[ring[c]]});
      ring.erase(ring.begin() + static_cast<ptrdiff_t>(b));
      tries = 0;
    } else {
      ++b;
      ++tries;
    }
  }
  fan(ring);
}

}  // namespace msq
