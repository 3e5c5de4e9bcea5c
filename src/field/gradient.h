// SPDX-License-Identifier: Apache-2.0
// A linear ramp between two points, constant beyond them.
#pragma once

#include "field/field.h"

namespace msq {

class GradientField final : public Field {
 public:
  GradientField(Vec3 from, double from_value, Vec3 to, double to_value);

  double at(Vec3 p) const override { return value(parameter(p)); }
  bool is_linear(const Box3& box, Vec3& gradient) const override;
  Interval range() const override;
  Interval range(const Box3& box) const override;
  double lipschitz() const override;
  std::optional<Slopes> slopes(const Box3& box) const override;

 private:
  void describe(HashInput& input) const override;
  double parameter(Vec3 p) const { return dot(p - from_, axis_) / axis_squared_; }
  /// The ramp parameter over a box: its middle, and the half width of its interval.
  struct Parameters {
    double middle, reach;
  };
  Parameters parameters(const Box3& box) const;
  double value(double t) const;

  Vec3 from_, axis_;
  double axis_squared_, from_value_, to_value_;
};

}  // namespace msq
