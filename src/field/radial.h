// SPDX-License-Identifier: Apache-2.0
// A linear ramp over the distance from a point or from a line, constant beyond.
#pragma once

#include "field/field.h"

namespace msq {

class RadialField final : public Field {
 public:
  struct Ramp {
    double from_radius, from_value, to_radius, to_value;  ///< 0 <= from_radius < to_radius
  };
  /// Uses the distance from the centre or, if the axis is not 0, from the line along the axis
  /// through the centre.
  RadialField(Vec3 centre, Vec3 axis, const Ramp& ramp);

  double at(Vec3 p) const override { return value(distance(p)); }
  bool is_linear(const Box3& box, Vec3& gradient) const override;
  Interval range() const override;
  Interval range(const Box3& box) const override;
  double lipschitz() const override;
  std::optional<Slopes> slopes(const Box3& box) const override;

 private:
  void describe(HashInput& input) const override;
  double distance(Vec3 p) const;
  double value(double distance) const;
  /// Bounds of distance(p) of a box, with its rounding, which is at most `slack`.
  Interval distances(const Box3& box, double& slack) const;

  Vec3 centre_, axis_;  // the axis of length 1, or 0
  Ramp ramp_;
};

}  // namespace msq
