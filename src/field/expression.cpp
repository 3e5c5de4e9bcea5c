// SPDX-License-Identifier: Apache-2.0
#include "field/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "expression/enclosure.h"
#include "expression/slope.h"

namespace msq {

bool ExpressionField::is_linear(const Box3& box, Vec3& gradient) const {
  // Only where it is constant.
  const Interval over = range(box);
  gradient = {};
  return over.low == over.high;
}

Interval ExpressionField::range(const Box3& box) const {
  thread_local std::vector<Enclosure> nodes;
  enclose(tape_, {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}}, nodes);
  // Infinite where a value may be no number, which counts as the least.
  return {cut(nodes.back().low), cut(nodes.back().high)};
}

double ExpressionField::lipschitz(const Box3& box) const {
  // Where more is lost in rounding, what is known of the function tells nothing of the values.
  constexpr double most_error = 0x1p-44;
  const Slope slope =
      enclose_slope(tape_, {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}},
                    {1, 1, 1}, 0);
  const double size = std::max(std::abs(range_.low), std::abs(range_.high));
  return slope.error <= most_error * size ? slope.most : std::numeric_limits<double>::infinity();
}

}  // namespace msq
