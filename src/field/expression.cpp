// SPDX-License-Identifier: Apache-2.0
#include "field/expression.h"

#include <vector>

#include "expression/enclosure.h"

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

}  // namespace msq
