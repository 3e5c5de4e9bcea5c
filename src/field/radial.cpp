// SPDX-License-Identifier: Apache-2.0
#include "field/radial.h"

namespace msq {

namespace {
Vec3 unit_or_zero(Vec3 v) {
  const double most = max_magnitude(v);
  if (most == 0) return {};
  const Vec3 scaled{v.x / most, v.y / most, v.z / most};  // squares neither overflow nor vanish
  return scaled * (1 / length(scaled));
}
}  // namespace

RadialField::RadialField(Vec3 centre, Vec3 axis, const Ramp& ramp)
    : centre_(centre), axis_(unit_or_zero(axis)), ramp_(ramp) {}

double RadialField::distance(Vec3 p) const {
  const Vec3 w = p - centre_;
  return length(w - axis_ * dot(w, axis_));
}

double RadialField::value(double distance) const {
  if (!(distance > ramp_.from_radius)) return ramp_.from_value;
  if (distance >= ramp_.to_radius) return ramp_.to_value;
  const double t = (distance - ramp_.from_radius) / (ramp_.to_radius - ramp_.from_radius);
  const double v = ramp_.from_value + t * (ramp_.to_value - ramp_.from_value);
  return std::clamp(v, range().low, range().high);
}

bool RadialField::is_linear(const Box3& box, Vec3& gradient) const {
  // True only where it is constant.
  const Interval over = range(box);
  gradient = {};
  return over.low == over.high;
}

Interval RadialField::range() const {
  return {std::min(ramp_.from_value, ramp_.to_value), std::max(ramp_.from_value, ramp_.to_value)};
}

Interval RadialField::range(const Box3& box) const {
  // Distances are monotone in each coordinate's magnitude from the centre. Distances from a line
  // change by at most the distance from the box's middle.
  double least, most;
  const Vec3 far = max(box.max - centre_, centre_ - box.min);
  if (max_magnitude(axis_) == 0) {
    least = length(max(max(box.min - centre_, centre_ - box.max), Vec3{}));
    most = length(far);
  } else {
    const double middle = distance((box.min + box.max) * 0.5);
    const Vec3 half = box.extent() * 0.5;
    // Only the component of the half diagonals normal to the line counts.
    double reach = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Vec3 h{half.x, corner & 1 ? -half.y : half.y, corner & 2 ? -half.z : half.z};
      reach = std::max(reach, length(h - axis_ * dot(h, axis_)));
    }
    least = middle - reach;
    most = middle + reach;
  }
  // Distances lose a few tens of units of 2^-53 of the coordinates, here and in at().
  const double slack = 0x1p-46 * (max_magnitude(far) + max_magnitude(centre_));
  // value() is monotone.
  const double a = value(least - slack), b = value(most + slack);
  return {std::min(a, b), std::max(a, b)};
}

double RadialField::lipschitz() const {
  // The slope along a radius; rounded up by more than the four operations lose.
  return std::abs(ramp_.to_value - ramp_.from_value) / (ramp_.to_radius - ramp_.from_radius) *
         (1 + 0x1p-48);
}

void RadialField::describe(HashInput& input) const {
  input.kind("field: radial");
  input.point(centre_);
  input.point(axis_);
  input.number(ramp_.from_radius);
  input.number(ramp_.from_value);
  input.number(ramp_.to_radius);
  input.number(ramp_.to_value);
}

}  // namespace msq
