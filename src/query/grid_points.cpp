// SPDX-License-Identifier: Apache-2.0
#include "query/grid_points.h"

namespace msq {

GridPoints::GridPoints(const SampleGrid& grid)
    : grid_(grid), bricks_({grid.nx, grid.ny, grid.nz}, grid.spacing, max_in_part) {}

void GridPoints::read(uint64_t first, uint64_t count, Vec3* out) const {
  for (uint64_t i = 0; i < count; ++i) out[i] = at(first + i);
}

void GridPoints::gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const {
  for (size_t i = 0; i < numbers.size(); ++i) out[i] = at(first + numbers[i]);
}

void GridPoints::read_part(uint64_t index, Part& part) const {
  part.numbers.clear();
  part.positions.clear();
  bricks_.for_each_cell(index, [&](uint64_t i, uint64_t j, uint64_t k) {
    part.numbers.push_back(i + grid_.nx * (j + grid_.ny * k));
    part.positions.push_back(grid_.at(i, j, k));
  });
}

}  // namespace msq
