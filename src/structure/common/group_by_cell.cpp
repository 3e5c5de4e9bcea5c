// SPDX-License-Identifier: Apache-2.0
#include "structure/common/group_by_cell.h"

#include <algorithm>

namespace msq {

std::vector<LocatedPoint> group_by_cell(const Neighbourhood& grid, const Vec3* points,
                                        const uint8_t* alive, size_t count) {
  constexpr int axis_bits = 14, index_bits = 64 - 3 * axis_bits;
  std::vector<LocatedPoint> located;
  CellIndex low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
  for (size_t i = 0; i < count; ++i) {
    if (!alive[i]) continue;
    located.push_back({grid.locate(points[i]), i});
    const CellIndex cell = located.back().located.cell;
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y), std::min(low.z, cell.z)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y), std::max(high.z, cell.z)};
  }
  if (located.empty()) return located;
  const int64_t most = int64_t{1} << axis_bits;
  if (int64_t{high.x} - low.x >= most || int64_t{high.y} - low.y >= most ||
      int64_t{high.z} - low.z >= most || located.size() > size_t{1} << index_bits)
    return located;
  // One word per point, cell in the high bits and position in the low bits: sorts faster than the
  // points themselves.
  std::vector<uint64_t> keys(located.size());
  for (size_t i = 0; i < located.size(); ++i) {
    const CellIndex cell = located[i].located.cell;
    const uint64_t x = static_cast<uint64_t>(cell.x - low.x),
                   y = static_cast<uint64_t>(cell.y - low.y),
                   z = static_cast<uint64_t>(cell.z - low.z);
    keys[i] = ((z << axis_bits | y) << axis_bits | x) << index_bits | i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<LocatedPoint> grouped;
  grouped.reserve(located.size());
  constexpr uint64_t index_mask = (uint64_t{1} << index_bits) - 1;
  for (const uint64_t key : keys) grouped.push_back(located[key & index_mask]);
  return grouped;
}

}  // namespace msq
