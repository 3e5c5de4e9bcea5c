// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as a coarse shape: membership by the winding number of the +x ray.
//
// A plane z cuts each triangle that it crosses (half-open in z: an end at z counts as below) in one
// segment between two of its edges, directed from the edge that runs up through the plane to the
// one that runs down. The end on an edge is computed from the edge's lower to its upper vertex, so
// the two triangles of an edge give the same bits, and the segments of a closed mesh form closed
// polygons with no gap at all. A row y cuts each segment (half-open in y) in one crossing, computed
// from the segment's end of smaller y. Winding numbers of closed meshes are thus consistent by
// construction, with no tolerance anywhere. Membership of a point is closed in x: on a crossing it
// is inside if either side is. The point form (inside) and the row form (fill_rows) share these
// expressions.
#pragma once

#include <memory>
#include <vector>

#include "base/lazy.h"
#include "base/memory.h"
#include "base/triangle_soup.h"
#include "shape/mesh_boundary.h"
#include "shape/shape.h"
#include "shape/triangle_bins.h"

namespace msq {

class Mesh final : public Shape {
 public:
  /// Welds equal vertices, drops triangles with fewer than three distinct ones, diagnoses the rest.
  /// Throws Error(mesh) on no triangles, indices out of range and non-finite vertices.
  Mesh(TriangleSoup soup, WindingRule rule, std::shared_ptr<MemoryBudget> budget);

  bool inside(Vec3 p) const override;
  void fill_rows(const RowBlock& block) const override;
  void prepare_distance() const override { boundary(); }
  bool knows_depth() const override { return true; }
  double depth_error() const override { return boundary().error(); }
  const BoundarySearch* boundary_search() const override { return &boundary(); }
  bool enter(const Ray& ray, double from, double to, double& t) const override;
  double leave(const Ray& ray, double from, double to) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  uint64_t self_intersections(const Job* job) const override;

  const std::vector<Vec3>& vertices() const { return soup_.vertices; }
  const std::vector<Triangle>& triangles() const { return soup_.triangles; }

 protected:
  double clearance(Vec3 p) const override { return boundary().clearance(p); }

 private:
  const MeshBoundary& boundary() const;
  bool solid(int64_t winding) const {
    return rule_ == WindingRule::nonzero    ? winding != 0
           : rule_ == WindingRule::even_odd ? (winding & 1) != 0
                                            : winding > 0;
  }
  void fill_layer(const RowBlock& block, uint64_t k) const;
  bool find_along(const Ray& ray, double from, double to, bool wanted, double& t) const;

  TriangleSoup soup_;
  WindingRule rule_;
  std::shared_ptr<MemoryBudget> budget_;
  Reservation reservation_;
  TriangleBins columns_;  // bins of y and z, for points
  TriangleBins sheets_;   // bins of z alone, for layers
  Lazy<MeshBoundary> boundary_;
};

}  // namespace msq
