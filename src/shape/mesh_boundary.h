// SPDX-License-Identifier: Apache-2.0
// The boundary of a mesh's solid, and the distance to it.
//
// The winding number of the +x ray from a point changes where the point crosses a triangle, and
// where the ray crosses an edge whose triangles run along it more often one way than the other. A
// closed mesh has no such edge: the boundary of its solid lies in its triangles. With open edges,
// rays through a hole leave the solid bounded also by what the ray of a point on such an edge
// sweeps backwards, a strip from the edge to the bounding box's side of least x, and by that side.
// Those strips are kept as triangles too. Some of the triangles may bound nothing (two shells that
// overlap); so the distance to the nearest one is a lower bound, exact where all of them do.
#pragma once

#include <memory>

#include "base/memory.h"
#include "base/triangle_soup.h"
#include "shape/boundary_search.h"
#include "shape/shape.h"
#include "shape/triangle_tree.h"

namespace msq {

enum class WindingRule : int32_t { nonzero = 0, even_odd = 1, positive = 2 };

class MeshBoundary final : public BoundarySearch {
 public:
  /// Throws Error(limit) where the budget has no room.
  MeshBoundary(const TriangleSoup& soup, const ShapeFacts& facts, WindingRule rule,
               const std::shared_ptr<MemoryBudget>& budget);

  /// As Shape::clearance().
  double clearance(Vec3 p) const;
  /// Bound of what clearance() may differ by from the distance to the triangles, of points in the
  /// mesh's bounding box.
  double error() const { return error_; }

  Foot nearest(Vec3 p, uint32_t start) const override;
  Range compare(Vec3 p, double low, double high, uint32_t& part) const override;
  /// The first t in [from, to] at which a ray may cross the boundary, and a vector normal to it
  /// there; false if there is none. `margin`: the error of positions.
  bool first_crossing(const Ray& ray, double from, double to, double margin, double& t,
                      Vec3& normal) const;

 private:
  // Coordinates times a power of two, which rounds nothing, so that the largest extent is about 1.
  double scale_;
  double error_;
  double slack_;  // scaled, of points at the bounding box; what else is lost grows with distance
  Reservation reservation_;
  TriangleTree tree_;
};

}  // namespace msq
