// SPDX-License-Identifier: Apache-2.0
// A shape whose surface is moved outwards or inwards: the points whose signed distance to the
// original is at most the offset.
#pragma once

#include "shape/shape.h"

namespace msq {

class OffsetShape final : public Shape {
 public:
  /// Outwards by a positive offset, inwards by a negative one; the original's distance must be
  /// exact on that side. Throws Error(argument) where an inward offset leaves no room in the
  /// bounds.
  OffsetShape(Ref<const Shape> original, double offset);

  bool inside(Vec3 p) const override {
    return bounds().contains(p) && original_->distance(p) <= offset_;
  }
  bool is_concurrent() const override { return original_->is_concurrent(); }
  void prepare_distance(const Job* job) const override { original_->prepare_distance(job); }
  bool is_exact_outside() const override { return offset_ > 0; }
  bool is_exact_inside() const override { return offset_ < 0; }
  bool knows_depth() const override { return offset_ < 0 && original_->knows_depth(); }
  double depth(Vec3 p) const override { return distance_bound(p); }
  double depth_error() const override { return 4 * error_; }
  Vec3 normal(const Ray& ray, double t) const override;
  /// The distance is 0 only next to the surface.
  double min_ray_step() const override { return ray_tolerance(); }
  void fill_rows(const RowBlock& block) const override;
  unsigned nesting() const override { return 1 + original_->nesting(); }
  uint64_t terms() const override { return original_->terms(); }

 protected:
  double distance_bound(Vec3 p) const override;

 private:
  void describe(HashInput& input) const override;
  Ref<const Shape> original_;
  double offset_;
  double error_;  // of the original's distances, in bounds()
};

}  // namespace msq
