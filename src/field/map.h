// SPDX-License-Identifier: Apache-2.0
// A piecewise linear curve over another field.
#pragma once

#include <algorithm>
#include <cmath>
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
  std::optional<Slopes> slopes(const Box3& box) const override;
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

inline std::optional<Slopes> MapField::slopes(const Box3& box) const {
  const std::optional<Slopes> argument = argument_->slopes(box);
  if (!argument) return {};
  const Interval by = curve_.slopes(argument_->range(box)), values = range();
  const double steepest = std::max(-by.low, by.high);
  // The curve loses a few units of 2^-53 of its values; slopes of pieces are 2^-50 too steep.
  const double size = std::max(std::abs(values.low), std::abs(values.high));
  const Vec3 across = box.extent() * max(argument->between.max, argument->between.min * -1);
  const double way = std::abs(across.x) + std::abs(across.y) + std::abs(across.z);
  Slopes slopes{{}, steepest * (argument->rounding + 0x1p-48 * way) + 0x1p-48 * size};
  if (!std::isfinite(slopes.rounding)) return {};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = argument->between.min[axis], high = argument->between.max[axis];
    const auto [least, most] =
        std::minmax({by.low * low, by.low * high, by.high * low, by.high * high});
    slopes.between.min[axis] = least;
    slopes.between.max[axis] = most;
  }
  return slopes;
}

}  // namespace msq
