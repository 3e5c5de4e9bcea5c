// SPDX-License-Identifier: Apache-2.0
// A piecewise linear curve over another field.
#pragma once

#include <utility>

#include "field/curve.h"
#include "field/field.h"

namespace msq {

class MapField final : public Field {
 public:
  MapField(Ref<const Field> argument, Curve curve)
      : argument_(std::move(argument)), curve_(std::move(curve)), depth_(1 + argument_->depth()) {}

  double at(Vec3 p) const override { return curve_(argument_->at(p)); }
  void values(const Vec3* points, size_t count, double* values) const override {
    argument_->values(points, count, values);
    for (size_t i = 0; i < count; ++i) values[i] = curve_(values[i]);
  }
  bool is_concurrent() const override { return argument_->is_concurrent(); }
  /// True only where the curve is constant over the box.
  bool is_linear(const Box3& box, Vec3& gradient) const override {
    const Interval over = range(box);
    gradient = {};
    return over.low == over.high;
  }
  // The curve's own values are those of at(), and it is monotone between its knots. So an enclosure
  // of the argument gives an enclosure of the field.
  Interval range() const override { return curve_.range(argument_->range()); }
  Interval range(const Box3& box) const override { return curve_.range(argument_->range(box)); }
  double lipschitz() const override {
    return product_of(curve_.lipschitz(), argument_->lipschitz());
  }
  double lipschitz(const Box3& box) const override {
    return product_of(curve_.lipschitz(argument_->range(box)), argument_->lipschitz(box));
  }
  unsigned depth() const override { return depth_; }

 private:
  void describe(HashInput& input) const override {
    input.kind("field: map");
    input.object(*argument_);
    curve_.describe(input);
  }
  static double product_of(double of_curve, double of_argument) {
    // If one of them is constant, so is the field, even if the other is steep.
    return of_curve > 0 && of_argument > 0 ? of_curve * of_argument * (1 + 0x1p-50) : 0;
  }

  Ref<const Field> argument_;
  Curve curve_;
  unsigned depth_;
};

}  // namespace msq
