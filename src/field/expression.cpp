// SPDX-License-Identifier: Apache-2.0
#include "field/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/borrowed.h"
#include "base/hash_input.h"
#include "expression/enclosure.h"
#include "expression/slope.h"

namespace msq {

bool ExpressionField::is_linear(const Box3& box, Vec3& gradient) const {
  // True only where it is constant.
  const Interval over = range(box);
  gradient = {};
  return over.low == over.high;
}

Interval ExpressionField::range(const Box3& box) const {
  const Borrowed<std::vector<Enclosure>> borrowed;
  std::vector<Enclosure>& nodes = *borrowed;
  enclose(tape_, {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}}, nodes);
  // An end is infinite if a value may be NaN, which counts as the minimum.
  return {cut(nodes.back().low), cut(nodes.back().high)};
}

double ExpressionField::lipschitz(const Box3& box) const {
  // With a larger rounding error, the slope of the function does not bound the values.
  constexpr double max_error = 0x1p-44;
  const Slope slope =
      enclose_slope(tape_, {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}},
                    {1, 1, 1}, 0);
  const double size = std::max(std::abs(range_.low), std::abs(range_.high));
  return slope.error <= max_error * size ? slope.most : std::numeric_limits<double>::infinity();
}

void ExpressionField::describe(HashInput& input) const {
  input.kind("field: expression");
  tape_.describe(input);
  input.number(range_.low);
  input.number(range_.high);
}

}  // namespace msq
