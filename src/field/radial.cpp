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

Interval RadialField::distances(const Box3& box, double& slack) const {
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
  slack = 0x1p-46 * (max_magnitude(far) + max_magnitude(centre_));
  return {least - slack, most + slack};
}

Interval RadialField::range(const Box3& box) const {
  double slack;
  const Interval d = distances(box, slack);
  // value() is monotone.
  const double a = value(d.low), b = value(d.high);
  return {std::min(a, b), std::max(a, b)};
}

std::optional<Slopes> RadialField::slopes(const Box3& box) const {
  double slack;
  const Interval d = distances(box, slack);
  const double slope = (ramp_.to_value - ramp_.from_value) / (ramp_.to_radius - ramp_.from_radius);
  const double rounding = 2 * slack * std::abs(slope) +
                          0x1p-48 * (std::abs(ramp_.from_value) + std::abs(ramp_.to_value));
  if (!std::isfinite(rounding)) return {};
  Slopes slopes{{}, rounding};
  if (d.high < ramp_.from_radius || d.low > ramp_.to_radius) return slopes;
  const bool is_ramp = d.low > ramp_.from_radius && d.high < ramp_.to_radius;
  // Along the direction from the point or the line, whose components are those of the way from
  // there over the distance.
  const Vec3 from = box.min - centre_, to = box.max - centre_;
  for (int i = 0; i < 3; ++i) {
    Interval way{-slack, slack};
    for (int j = 0; j < 3; ++j) {
      const double m = (i == j ? 1 : 0) - axis_[i] * axis_[j];
      way.low += std::min(m * from[j], m * to[j]);
      way.high += std::max(m * from[j], m * to[j]);
    }
    const auto component = [&](double v, double sign) {
      const double nearest = v * sign > 0 ? d.low : d.high;
      return nearest > 0 ? std::clamp(v / nearest, -1.0, 1.0) : v * sign > 0 ? sign : 0;
    };
    const double low = component(way.low, -1) * slope, high = component(way.high, 1) * slope;
    slopes.between.min[i] = std::min(low, high);
    slopes.between.max[i] = std::max(low, high);
  }
  if (!is_ramp) slopes.between = {min(slopes.between.min, Vec3{}), max(slopes.between.max, Vec3{})};
  return slopes;
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
