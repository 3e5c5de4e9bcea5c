// SPDX-License-Identifier: Apache-2.0
#include "structure/common/struts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/status.h"
#include "field/field.h"

namespace msq {

Box3 StrutSelection::around(double reach) const {
  if (is_owned) return box;
  // Thousands of times the rounding of positions, so that rounding leaves out no strut.
  const double slack = 0x1p-40 * (reach + std::max(max_magnitude(box.min), max_magnitude(box.max)));
  return box.grown(reach + slack);
}

bool StrutSelection::selects(Vec3 a, Vec3 b, double reach) const {
  if (is_owned) {
    const Vec3 middle = (a + b) * 0.5;
    for (int axis = 0; axis < 3; ++axis)
      if (!(middle[axis] >= box.min[axis] && middle[axis] < box.max[axis])) return false;
    return true;
  }
  // The part of the line in the box. Each quotient is computed from one end, the lower one along
  // the axis, so that both directions round alike.
  const Box3 grown = around(reach);
  double low = 0, high = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = b[axis] - a[axis];
    if (std::max(a[axis], b[axis]) < grown.min[axis] ||
        std::min(a[axis], b[axis]) > grown.max[axis])
      return false;
    if (way == 0) continue;
    const double inverse = 1 / way;
    if (!std::isfinite(inverse)) continue;
    double near = (grown.min[axis] - a[axis]) * inverse,
           far = (grown.max[axis] - a[axis]) * inverse;
    if (near > far) std::swap(near, far);
    low = std::max(low, near);
    high = std::min(high, far);
  }
  return low <= high + 0x1p-40;
}

StrutCells::StrutCells(const Neighbourhood& grid, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::ceil(box.min[axis] / grid.cell_size[axis] - 1 - 1e-6);
    const double high = std::floor(box.max[axis] / grid.cell_size[axis] + 1e-6);
    if (!(low > -max_cell_index && high < max_cell_index))
      fail(Status::limit,
           "the box reaches from cell %g to cell %g along axis %d; the limit is %g cells from the "
           "grid's origin",
           low, high, axis, max_cell_index);
    first[axis] = static_cast<int64_t>(low);
    last[axis] = static_cast<int64_t>(high);
  }
}

void set_radii(const Parameter& radius, size_t from, StrutList& list) {
  constexpr size_t at_once = 64;
  Vec3 points[2 * at_once];
  double values[2 * at_once];
  for (size_t first = from; first < list.struts.size(); first += at_once) {
    const size_t count = std::min(at_once, list.struts.size() - first);
    for (size_t i = 0; i < count; ++i) {
      points[2 * i] = list.struts[first + i].a;
      points[2 * i + 1] = list.struts[first + i].b;
    }
    radius.values(points, 2 * count, values);
    for (size_t i = 0; i < count; ++i)
      for (size_t end = 0; end < 2; ++end)
        list.struts[first + i].radii[end] = list.factors[first + i] * values[2 * i + end];
  }
}

}  // namespace msq
