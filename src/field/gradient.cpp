// SPDX-License-Identifier: Apache-2.0
#include "field/gradient.h"

namespace msq {

GradientField::GradientField(Vec3 from, double from_value, Vec3 to, double to_value)
    : from_(from),
      axis_(to - from),
      axis_squared_(dot(axis_, axis_)),
      from_value_(from_value),
      to_value_(to_value) {}

double GradientField::value(double t) const {
  if (!(t > 0)) return from_value_;  // also where products overflow to infinities that cancel
  if (t >= 1) return to_value_;
  const double v = from_value_ + t * (to_value_ - from_value_);
  return std::clamp(v, std::min(from_value_, to_value_), std::max(from_value_, to_value_));
}

GradientField::Parameters GradientField::parameters(const Box3& box) const {
  const Vec3 half = box.extent() * 0.5;
  const double t = parameter((box.min + box.max) * 0.5);
  return {t,
          (std::abs(axis_.x) * half.x + std::abs(axis_.y) * half.y + std::abs(axis_.z) * half.z) /
              axis_squared_};
}

bool GradientField::is_linear(const Box3& box, Vec3& gradient) const {
  const auto [t, reach] = parameters(box);
  // Away from the ends by more than rounding, which stays below 2^-40 of the range.
  const double magnitude = max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(from_);
  if (!(t - reach > 1e-6 && t + reach < 1 - 1e-6)) return false;
  if (!(magnitude < 1000 * std::sqrt(axis_squared_))) return false;
  gradient = axis_ * ((to_value_ - from_value_) / axis_squared_);
  return true;
}

Interval GradientField::range() const {
  return {std::min(from_value_, to_value_), std::max(from_value_, to_value_)};
}

double GradientField::lipschitz() const {
  // The slope along the axis; clamping does not increase it. Rounded up by more than the three
  // operations lose.
  return std::abs(to_value_ - from_value_) / std::sqrt(axis_squared_) * (1 + 0x1p-50);
}

Interval GradientField::range(const Box3& box) const {
  const auto [t, reach] = parameters(box);
  // The error of t is at most 9 units of 2^-53 of the inputs, from p minus from_, products and
  // sums, here and in at(). 2^-40 of all that is thousands of them, and 2^-46 of large coordinates
  // over a hundred.
  const double magnitude = max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(from_);
  const double far = magnitude / std::sqrt(axis_squared_), near = std::min(far, 16.0);
  const double slack = 0x1p-40 * (1 + reach + std::abs(t) + near) + 0x1p-46 * (far - near);
  const double a = value(t - reach - slack), b = value(t + reach + slack);
  const double rounding = 0x1p-50 * (std::abs(from_value_) + std::abs(to_value_));
  const Interval all = range();
  return {std::max(all.low, std::min(a, b) - rounding),
          std::min(all.high, std::max(a, b) + rounding)};
}

std::optional<Slopes> GradientField::slopes(const Box3& box) const {
  const auto [t, reach] = parameters(box);
  // The error of t, as in range(box), and of the slope times the way across the box.
  const double far = (max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(from_)) /
                     std::sqrt(axis_squared_);
  const double slack = 0x1p-46 * (1 + reach + std::abs(t) + far);
  const double rise = to_value_ - from_value_;
  const double rounding =
      slack * std::abs(rise) + 0x1p-50 * (std::abs(from_value_) + std::abs(to_value_));
  if (t + reach < -slack || t - reach > 1 + slack) return Slopes{{}, rounding};
  const Vec3 slope = axis_ * (rise / axis_squared_);
  if (t - reach > slack && t + reach < 1 - slack) return Slopes{{slope, slope}, rounding};
  return Slopes{{min(slope, Vec3{}), max(slope, Vec3{})}, rounding};
}

void GradientField::describe(HashInput& input) const {
  input.kind("field: gradient");
  input.point(from_);
  input.point(axis_);
  input.number(from_value_);
  input.number(to_value_);
}

}  // namespace msq
