// SPDX-License-Identifier: Apache-2.0
// Self-intersections by CGAL. A streamed segment tree finds the pairs of triangles whose boxes
// meet; exact predicates test each pair. The criterion is that of
// CGAL::Polygon_mesh_processing::self_intersections. That function itself requires a manifold,
// consistently oriented mesh, which a mesh to diagnose may not be.
// Source: Zomorodian and Edelsbrunner, "Fast software for box intersections", 2002.
//
// CGAL's box intersection is under the GPL. So a build with this file is, too.
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/box_intersection_d.h>

#include "shape/self_intersections.h"

namespace msq {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

/// Runs of fewer boxes are scanned instead of divided further; CGAL's own choice for meshes.
constexpr std::ptrdiff_t scan_cutoff = 2000;

class PairTest {
 public:
  explicit PairTest(const Mesh& mesh) : vertices_(mesh.vertices()) {}

  /// The predicates on pairs need triangles with area.
  bool has_area(const Triangle& t) const {
    return !CGAL::collinear(point(t[0]), point(t[1]), point(t[2]));
  }

  bool intersect(const Triangle& a, const Triangle& b) const {
    int shared = 0, in_a[3], in_b[3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (a[i] == b[j]) in_a[shared] = i, in_b[shared++] = j;
    switch (shared) {
      case 0:
        return CGAL::do_intersect(triangle(a), triangle(b));
      case 1:  // any other common point is the end of a segment from the vertex to an opposite edge
        return CGAL::do_intersect(triangle(a), opposite_edge(b, in_b[0])) ||
               CGAL::do_intersect(triangle(b), opposite_edge(a, in_a[0]));
      case 2: {  // folded flat onto one another?
        const Point p = point(a[in_a[0]]), q = point(a[in_a[1]]);
        const Point r = point(a[3 - in_a[0] - in_a[1]]), s = point(b[3 - in_b[0] - in_b[1]]);
        return CGAL::coplanar(p, q, r, s) &&
               CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
      }
      default:
        return true;
    }
  }

 private:
  Point point(uint32_t vertex) const {
    const Vec3& v = vertices_[vertex];
    return {v.x, v.y, v.z};
  }
  Kernel::Triangle_3 triangle(const Triangle& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }
  Kernel::Segment_3 opposite_edge(const Triangle& t, int corner) const {
    return {point(t[(corner + 1) % 3]), point(t[(corner + 2) % 3])};
  }

  const std::vector<Vec3>& vertices_;
};

CGAL::Bbox_3 bounds_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 low = min(a, min(b, c)), high = max(a, max(b, c));
  return {low.x, low.y, low.z, high.x, high.y, high.z};
}

}  // namespace

uint64_t count_self_intersections(const Mesh& mesh, const Job* job) {
  const std::vector<Triangle>& triangles = mesh.triangles();
  const std::vector<Vec3>& vertices = mesh.vertices();
  const PairTest test(mesh);

  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    check_cancelled(job);
    const Triangle& t = triangles[i];
    if (test.has_area(t))
      boxes.emplace_back(bounds_of(vertices[t[0]], vertices[t[1]], vertices[t[2]]), i);
  }
  // CGAL moves its arguments around: pointers are cheaper, and keep the identity of the boxes.
  std::vector<const Box*> handles;
  handles.reserve(boxes.size());
  for (const Box& box : boxes) handles.push_back(&box);

  uint64_t pairs = 0;
  CGAL::box_self_intersection_d(
      handles.begin(), handles.end(),
      [&](const Box* a, const Box* b) {
        check_cancelled(job);
        if (test.intersect(triangles[a->info()], triangles[b->info()])) ++pairs;
      },
      scan_cutoff);
  return pairs;
}

}  // namespace msq
