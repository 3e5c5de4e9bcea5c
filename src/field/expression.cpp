// SPDX-License-Identifier: Apache-2.0
#include "field/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/borrowed.h"
#include "base/hash_input.h"
#include "expression/batch.h"
#include "expression/enclosure.h"
#include "expression/slope.h"

namespace msq {

namespace {

/// For fewer points, the preparation of vectors costs more than they save.
constexpr size_t min_vectors = 32;

struct Coordinates {
  double axis[3][batch_points + batch_padding] = {};
};

}  // namespace

void ExpressionField::values(const Vec3* points, size_t count, double* values) const {
  if (count < min_vectors) return Field::values(points, count, values);
  Batch batch(program_);
  const Borrowed<Coordinates> coordinates;
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {coordinates->axis[axis], false});
  for (size_t first = 0; first < count; first += batch_points) {
    const size_t size = std::min(batch_points, count - first);
    for (size_t i = 0; i < size; ++i)
      for (int axis = 0; axis < 3; ++axis) coordinates->axis[axis][i] = points[first + i][axis];
    batch.run(size);
    const Values found = batch.output(0);
    for (size_t i = 0; i < size; ++i) values[first + i] = cut(found[i]);
  }
}

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

std::optional<Slopes> ExpressionField::slopes(const Box3& box) const {
  const std::optional<Derivatives> found = enclose_derivatives(
      tape_, {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}});
  if (!found) return {};
  const auto& [value, along, error] = *found;
  Slopes slopes{{}, error};
  if (value.high < range_.low || value.low > range_.high) return slopes;
  const bool is_cut = value.low < range_.low || value.high > range_.high;
  for (int axis = 0; axis < 3; ++axis) {
    slopes.between.min[axis] = is_cut ? std::min(along[axis].low, 0.0) : along[axis].low;
    slopes.between.max[axis] = is_cut ? std::max(along[axis].high, 0.0) : along[axis].high;
  }
  return slopes;
}

void ExpressionField::describe(HashInput& input) const {
  input.kind("field: expression");
  tape_.describe(input);
  input.number(range_.low);
  input.number(range_.high);
}

}  // namespace msq
