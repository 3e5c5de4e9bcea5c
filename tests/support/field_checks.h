// SPDX-License-Identifier: Apache-2.0
// What every field promises, checked at random boxes and points.
#pragma once

#include <cmath>

#include "field/field.h"
#include "msq_test.h"
#include "random.h"

namespace msq::test {

/// How well a field knows itself.
struct FieldOutcome {
  size_t boxes = 0;
  size_t linear = 0;   ///< boxes on which it is known to be linear
  size_t bounded = 0;  ///< whose Lipschitz constant is known
  size_t sloped = 0;   ///< whose slopes are known
  double width = 0;    ///< range of a box over that of the points sampled in it: least
};

/// Checks range(), is_linear(), lipschitz() and slopes(), of all and of boxes, of a field by
/// `boxes` boxes, of sizes from `least` to `most`, in `space`.
inline FieldOutcome check_field(const Field& field, const Box3& space, double least, double most,
                                size_t boxes, Random& random) {
  FieldOutcome outcome;
  outcome.boxes = boxes;
  outcome.width = 1e300;
  const Interval all = field.range();
  const double lipschitz = field.lipschitz();
  const double rounded = 0x1p-43 * std::max(std::abs(all.low), std::abs(all.high));
  if (!(std::isfinite(all.low) && std::isfinite(all.high) && all.low <= all.high))
    fail_msg("range() is %g to %g", all.low, all.high);
  if (!(lipschitz >= 0)) fail_msg("lipschitz() is %g", lipschitz);
  for (size_t n = 0; n < boxes; ++n) {
    const double size = least * std::pow(most / least, random.unit());
    const Vec3 corner = random.in_box(space);
    Box3 box{corner, corner + random.in_box({{0, 0, 0}, {size, size, size}})};
    if (n % 8 == 0) box.max = corner;
    if (n % 8 == 1) box.max = {corner.x, box.max.y, corner.z};
    const Interval range = field.range(box);
    if (range.low < all.low || range.high > all.high)
      fail_msg("range of a box, %.17g to %.17g, is not within %.17g to %.17g", range.low,
               range.high, all.low, all.high);
    Vec3 gradient;
    const bool is_linear = field.is_linear(box, gradient);
    outcome.linear += is_linear;
    const double in_box = field.lipschitz(box);
    if (!(in_box <= lipschitz))
      fail_msg("lipschitz() of a box is %g, %g of all", in_box, lipschitz);
    outcome.bounded += std::isfinite(in_box);
    const std::optional<Slopes> slopes = field.slopes(box);
    outcome.sloped += slopes.has_value();
    double low = 1e300, high = -1e300;
    Vec3 last = box.min;
    for (int i = 0; i < 24; ++i) {
      Vec3 p = random.in_box(box);
      if (i < 8)
        p = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
             i & 4 ? box.max.z : box.min.z};
      const double v = field.at(p);
      if (!(v >= range.low && v <= range.high))
        fail_msg("%.17g at (%.17g, %.17g, %.17g) is not within %.17g to %.17g", v, p.x, p.y, p.z,
                 range.low, range.high);
      low = std::min(low, v);
      high = std::max(high, v);
      const double change = std::abs(v - field.at(last)), way = length(p - last);
      const Interval here = field.range(Box3{p, p}), there = field.range(Box3{last, last});
      const double rounding = (here.high - here.low) + (there.high - there.low);
      if (way > 0 && !(change <= lipschitz * way * (1 + 1e-12) + rounding))
        fail_msg("changes by %.17g within %.17g, Lipschitz constant %.17g", change, way, lipschitz);
      if (way > 0 && !(change <= in_box * way * (1 + 1e-12) + rounding + rounded))
        fail_msg("changes by %.17g within %.17g, Lipschitz constant of the box %.17g", change, way,
                 in_box);
      if (slopes) {
        double lowest = 0, highest = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double along = (p - last)[axis];
          const double by_min = along * slopes->between.min[axis];
          const double by_max = along * slopes->between.max[axis];
          lowest += std::min(by_min, by_max);
          highest += std::max(by_min, by_max);
        }
        const double slack = 2 * slopes->rounding + 1e-12 * (std::abs(lowest) + std::abs(highest));
        const double rise = v - field.at(last);
        if (!(rise >= lowest - slack && rise <= highest + slack))
          fail_msg("changes by %.17g, by its slopes by %.17g to %.17g", rise, lowest, highest);
      }
      last = p;
      if (!is_linear) continue;
      const double along = field.at(box.min) + dot(gradient, p - box.min);
      if (!(std::abs(v - along) <= 0x1p-40 * (all.high - all.low)))
        fail_msg("%.17g, by the gradient %.17g", v, along);
    }
    if (high > low)
      outcome.width = std::min(outcome.width, (range.high - range.low) / (high - low));
  }
  return outcome;
}

}  // namespace msq::test
