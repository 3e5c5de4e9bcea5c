// SPDX-License-Identifier: Apache-2.0
// A shape placed by an affine map. It shares all that the original has built: a point is inside
// where the original holds the point that the stored inverse maps it to (placement.h).
#pragma once

#include "shape/boundary_search.h"
#include "shape/placed_rows.h"
#include "shape/placement.h"
#include "shape/shape.h"

namespace msq {

class PlacedShape final : public Shape, private BoundarySearch {
 public:
  PlacedShape(Ref<const Shape> original, const Placement& placement);

  bool inside(Vec3 p) const override {
    return bounds().contains(p) && original_->inside(placement_.to_original(p));
  }
  void find_inside(const Vec3* points, size_t count, uint8_t* inside) const override;
  bool is_concurrent() const override { return original_->is_concurrent(); }
  bool has_steady_distance() const override { return original_->has_steady_distance(); }
  bool is_exact_outside() const override {
    return placement_.is_similarity() && original_->is_exact_outside();
  }
  bool is_exact_inside() const override {
    return placement_.is_similarity() && original_->is_exact_inside();
  }
  void prepare_distance(const Job* job) const override { original_->prepare_distance(job); }
  void prepare_rows(const Job* job) const override { rows_.prepare(*this, job); }
  MeshMap mesh_map() const override;
  /// The depth of stretched shapes is not known: their distance is a bound.
  bool knows_depth() const override {
    return placement_.is_similarity() && original_->knows_depth();
  }
  double depth(Vec3 p) const override;
  double depth(Vec3 p, double) const override { return depth(p); }
  double depth_error() const override;
  const BoundarySearch* boundary_search() const override;
  bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  bool gains_by_rays() const override { return original_->gains_by_rays(); }
  void enter_all(RaySearch* searches, size_t count, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  uint64_t self_intersections(const Job* job) const override {
    return original_->self_intersections(job);
  }
  void fill_rows(const RowBlock& block) const override { rows_.fill(*this, block); }
  unsigned nesting() const override { return 1 + original_->nesting(); }
  uint64_t terms() const override { return original_->terms(); }

 protected:
  /// Exact, except for rounding, if the original's is and all lengths grow alike; otherwise at
  /// least the original's times the least growth, and that to the bounds.
  double distance_bound(Vec3 p) const override;

 private:
  void describe(HashInput& input) const override;
  Foot nearest(Vec3 p, uint32_t start) const override;
  Range compare(Vec3 p, double low, double high, uint32_t& part) const override;
  bool follow(const Ray& ray, double from, double to, double first, double& t,
              const Job* job) const;

  Ref<const Shape> original_;
  const Placement placement_;
  PlacedRows rows_;
};

}  // namespace msq
