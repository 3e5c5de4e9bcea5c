// SPDX-License-Identifier: Apache-2.0
// The boundary of a mesh's solid, and the distance to it.
//
// The winding number of the +x ray from a point changes where the point crosses a triangle, and
// where the ray crosses an edge whose triangles run along it more often in one direction than in
// the other. A closed mesh has no such edge: the boundary of its solid lies in its triangles. With
// open edges, rays through a hole add more boundary: the strip that the ray of a point on such an
// edge sweeps backwards, from the edge to the bounding box's side of minimum x, and that side.
// Those strips are stored as triangles too, except with the rule `automatic`, for which rays do not
// decide (open_mesh.h). Some of the triangles may not bound the solid (two shells that overlap). So
// the distance to the nearest one is a lower bound; it is exact if all of them do.
#pragma once

#include <memory>

#include "base/memory.h"
#include "base/triangle_soup.h"
#include "shape/boundary_search.h"
#include "shape/shape.h"
#include "shape/triangle_tree.h"

namespace msq {

enum class WindingRule : int32_t { nonzero = 0, even_odd = 1, positive = 2, automatic = 3 };

class MeshBoundary final : public BoundarySearch {
 public:
  /// Throws Error(limit) if the budget is exceeded, Error(cancelled) if the job, which may be null,
  /// is cancelled.
  MeshBoundary(const TriangleSoup& soup, const ShapeFacts& facts, WindingRule rule,
               const std::shared_ptr<MemoryBudget>& budget, const Job* job);

  /// As Shape::distance_bound().
  double distance_bound(Vec3 p) const;
  /// Bound of the difference between distance_bound() and the distance to the triangles, for points
  /// in the mesh's bounding box.
  double error() const { return error_; }

  Foot nearest(Vec3 p, uint32_t start) const override;
  Range compare(Vec3 p, double low, double high, uint32_t& part) const override;
  /// Finds the first t in [from, to] at which a ray may cross the boundary, and a vector normal to
  /// it there. Returns false if there is none. `margin`: the error of positions.
  bool first_crossing(const Ray& ray, double from, double to, double margin, double& t,
                      Vec3& normal) const;

 private:
  // A power of two by which coordinates are multiplied, without rounding, so that the largest
  // extent is about 1.
  double scale_;
  double error_;
  double slack_;  // scaled, for points at the bounding box; other errors grow with distance
  Reservation reservation_;
  TriangleTree tree_;
};

}  // namespace msq
