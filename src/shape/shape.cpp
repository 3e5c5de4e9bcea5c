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
  const SampleGrid& grid = *block.grid;
  const Box3& box = bounds();
  const uint64_t first = first_sample_from(grid.origin.x, grid.spacing.x, grid.nx, box.min.x);
  const uint64_t end = first_sample_from<true>(grid.origin.x, grid.spacing.x, grid.nx, box.max.x);
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    const double z = grid.z(k);
    if (z < box.min.z || z > box.max.z) continue;
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const double y = grid.y(j);
      if (y < box.min.y || y > box.max.y) continue;
      uint64_t* row = block.row(j, k);
      for (uint64_t i = first; i < end; ++i)
        if (inside({grid.x(i), y, z})) row[i / bits_per_word] |= uint64_t{1} << (i % bits_per_word);
    }
  }
}

}  // namespace msq
