// SPDX-License-Identifier: Apache-2.0
// The shape of models that are structures alone: every point is inside, and there is no boundary.
#pragma once

#include "base/hash_input.h"
#include "shape/shape.h"

namespace msq {

class AllSpace final : public Shape {
 public:
  AllSpace() {
    constexpr double far = std::numeric_limits<double>::infinity();
    facts_.bounds = {{-far, -far, -far}, {far, far, far}};
    facts_.is_bounded = false;
    facts_.volume = far;
  }

  bool inside(Vec3) const override { return true; }
  bool enter(const Ray&, double from, double to, double& t, const Job*) const override {
    t = from;
    return from <= to;
  }
  double leave(const Ray&, double, double to, const Job*) const override { return to; }
  Vec3 normal(const Ray& ray, double) const override { return ray.direction * -1.0; }
  void fill_rows(const RowBlock& block) const override { set_all_bits(block); }
  bool fills_rows_apart() const override { return true; }
  bool holds_block(const RowBlock&) const override { return true; }

 protected:
  /// Distances are finite.
  double distance_bound(Vec3) const override { return std::numeric_limits<double>::max(); }
  void describe(HashInput& input) const override { input.kind("shape: all space"); }
};

}  // namespace msq
