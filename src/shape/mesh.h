// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as a coarse shape: membership by the winding number of the +x ray.
//
// A plane z cuts each triangle that it crosses (half-open in z: an end at z counts as below) in one
// segment between two of its edges, directed from the edge that runs up through the plane to the
// one that runs down. The end on an edge is computed from the edge's lower to its upper vertex. So
// the two triangles of an edge give the same bits, and the segments of a closed mesh form closed
// polygons without gaps. A row y cuts each segment (half-open in y) in one crossing, computed from
// the segment's end of smaller y. So winding numbers of closed meshes are consistent by
// construction, without any tolerance. Membership of a point is closed in x: a point on a crossing
// is inside if either side is. The point form (inside) and the row form (fill_rows) share these
// expressions (triangle_rows.h).
//
// With the rule `automatic`, the solid angle of its holes corrects the winding number of an open
// mesh (open_mesh.h).
#pragma once

#include <memory>
#include <vector>

#include "base/lazy.h"
#include "base/memory.h"
#include "base/triangle_soup.h"
#include "shape/decided_cells.h"
#include "shape/mesh_boundary.h"
#include "shape/open_mesh.h"
#include "shape/shape.h"
#include "shape/triangle_bins.h"

namespace msq {

class Mesh final : public Shape {
 public:
  /// Welds equal vertices, drops triangles with fewer than three distinct ones, diagnoses the rest.
  /// Throws Error(mesh) on no triangles, indices out of range and non-finite vertices.
  Mesh(TriangleSoup soup, WindingRule rule, std::shared_ptr<MemoryBudget> budget,
       const JobPart& part = {});

  bool inside(Vec3 p) const override;
  void fill_rows(const RowBlock& block) const override;
  uint64_t layers_together() const override;
  void prepare_distance(const Job* job) const override { boundary(job); }
  bool has_steady_distance() const override { return !open_ || open_->is_steady(); }
  /// To the triangles, of which some may bound nothing.
  bool is_exact_outside() const override { return facts_.closed; }
  bool is_exact_inside() const override { return facts_.closed; }
  bool knows_depth() const override { return true; }
  /// To the triangles: holes have no surface, hence no skin.
  double depth(Vec3 p) const override { return boundary().distance_bound(p); }
  double depth(Vec3 p, double distance) const override { return open_ ? depth(p) : -distance; }
  double depth_error() const override { return boundary().error(); }
  const BoundarySearch* boundary_search() const override { return &boundary(); }
  bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  uint64_t self_intersections(const Job* job) const override;

  /// Whether points of this winding number are inside; of an open mesh its holes may correct it.
  bool solid(int64_t winding) const {
    return rule_ == WindingRule::even_odd   ? (winding & 1) != 0
           : rule_ == WindingRule::positive ? winding > 0
                                            : winding != 0;
  }
  MeshMap mesh_map() const override;
  const std::shared_ptr<MemoryBudget>& budget() const { return budget_; }
  const std::vector<Vec3>& vertices() const { return soup_.vertices; }
  const std::vector<Triangle>& triangles() const { return soup_.triangles; }

 protected:
  double distance_bound(Vec3 p) const override {
    return open_ ? open_distance_bound(p) : boundary().distance_bound(p);
  }

 private:
  void describe(HashInput& input) const override;
  const MeshBoundary& boundary(const Job* job = nullptr) const;
  const DecidedCells& cells(const Job* job) const;
  void fill_open_rows(const RowBlock& block) const;
  double open_distance_bound(Vec3 p) const;
  bool find_along(const Ray& ray, double from, double to, bool wanted, double& t,
                  const Job* job) const;
  bool find_between(const Ray& ray, double from, double to, bool wanted, double& t,
                    LeastStep& least, JobPoll& poll) const;
  bool find_along_open(const Ray& ray, double from, double to, bool wanted, double& t,
                       const Job* job) const;

  TriangleSoup soup_;
  WindingRule rule_;
  std::shared_ptr<MemoryBudget> budget_;
  Reservation reservation_;
  TriangleBins columns_;                  // bins of y and z, for points
  TriangleBins sheets_;                   // bins of z alone, for layers
  std::unique_ptr<const OpenMesh> open_;  // of open meshes by the rule `automatic`
  Lazy<MeshBoundary> boundary_;
  Lazy<DecidedCells> cells_;  // of closed meshes
};

}  // namespace msq
