// SPDX-License-Identifier: Apache-2.0
#include "shape/shape.h"

#include <limits>

#include "base/signed_distance.h"

namespace msq {

double Shape::distance(Vec3 p) const {
  const Box3& box = bounds();
  const Vec3 gap = max(max(box.min - p, p - box.max), Vec3{});
  // From so far away the box is as near as what it holds, to the last bits, and squares might
  // overflow.
  if (max_component(gap) > 0x1p60 * max_component(box.extent())) {
    const double far = std::hypot(gap.x, gap.y, gap.z) * (1 - 0x1p-50);
    return std::min(far, std::numeric_limits<double>::max());
  }
  return signed_distance(inside(p), clearance(p));
}

void Shape::fill_rows(const RowBlock& block) const {
  for_each_row_in_bounds(block,
                         [&](double y, double z, uint64_t* row, uint64_t first, uint64_t end) {
                           for (uint64_t i = first; i < end; ++i)
                             if (inside({block.grid->x(i), y, z})) set_bits(row, i, i);
                         });
}

}  // namespace msq
