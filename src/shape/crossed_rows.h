// SPDX-License-Identifier: Apache-2.0
// The rows of a layer that triangles cross, filled by winding numbers.
#pragma once

#include <algorithm>
#include <vector>

#include "base/borrowed.h"
#include "shape/triangle_bins.h"
#include "shape/triangle_rows.h"

namespace msq {

/// Memory for the rows of a layer.
struct CrossedRowsMemory {
  std::vector<RowCrossing> crossings, sorted;
  std::vector<uint32_t> row_ends;

  size_t bytes() const {
    return (crossings.capacity() + sorted.capacity()) * sizeof(RowCrossing) +
           row_ends.capacity() * sizeof(uint32_t);
  }
};

/// Sets the bits of the samples of layer k in a box where solid(winding number) is true. sheets:
/// bins of the triangles in z alone.
template <class Solid>
void fill_crossed_rows(const TriangleSoup& soup, const TriangleBins& sheets, const Box3& box,
                       const RowBlock& block, uint64_t k, Solid&& solid) {
  const SampleGrid& grid = *block.grid;
  const double z = grid.z(k);
  if (z < box.min.z || z > box.max.z) return;

  const Borrowed<CrossedRowsMemory> memory;
  auto& [crossings, sorted, row_ends] = *memory;
  crossings.clear();
  add_crossings(soup, sheets.at(box.min.y, z), block, k, crossings);
  sort_by_row(crossings, block.rows(), row_ends, sorted);

  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  for (uint64_t r = 0; r < block.rows(); ++r) {
    const double y = grid.y(block.y0 + r);
    if (y < box.min.y || y > box.max.y) continue;
    RowCrossing* const row_begin = sorted.data() + (r ? row_ends[r - 1] : 0);
    RowCrossing* const row_end = sorted.data() + row_ends[r];
    if (row_begin == row_end) continue;
    std::sort(row_begin, row_end,
              [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
    fill_between(row_begin, row_end, grid, first, end, block.row(block.y0 + r, k), solid);
  }
}

}  // namespace msq
