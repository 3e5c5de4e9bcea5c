// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/row_angles.h"

#include <algorithm>

namespace msq {

RowAngles::RowAngles(const Functional& structure, const RowBlock& block) {
  const SampleGrid& grid = *block.grid;
  const uint64_t first[3] = {0, block.y0, block.z0};
  const uint64_t count[3] = {block.row_words() * bits_per_word, block.rows(), block.layers()};
  for (int axis = 0; axis < 3; ++axis) {
    // The other two coordinates do not matter.
    std::vector<double> positions(count[axis] + batch_padding), angles[3];
    for (uint64_t i = 0; i < count[axis]; ++i)
      positions[i] = axis == 0   ? grid.x(std::min(i, grid.nx - 1))
                     : axis == 1 ? grid.y(first[1] + i)
                                 : grid.z(first[2] + i);
    const double x = grid.x(0), y = grid.y(block.y0), z = grid.z(block.z0);
    const Values x_or = {axis == 0 ? positions.data() : &x, axis != 0};
    const Values y_or = {axis == 1 ? positions.data() : &y, axis != 1};
    const Values z_or = {axis == 2 ? positions.data() : &z, axis != 2};
    for (auto& a : angles) a.resize(count[axis] + batch_padding);
    structure.angles().find(x_or, y_or, z_or, count[axis],
                            {angles[0].data(), angles[1].data(), angles[2].data()});
    for (size_t a = 0; a < 3; ++a)
      if (structure.sample_axis()[a] == axis) of[axis] = std::move(angles[a]);
  }
}

size_t RowAngles::period(const SampleGrid& grid) const {
  const std::vector<double>& angles = of[0];
  const size_t row_words = words_for(grid.nx);
  for (size_t words = 1; 2 * words <= row_words; ++words) {
    const size_t period = words * bits_per_word;
    if (angles[period] != angles[0]) continue;
    bool is_period = true;
    for (uint64_t i = period; i < grid.nx && is_period; ++i)
      is_period = angles[i] == angles[i - period];
    if (is_period) return words;
  }
  return row_words;
}

}  // namespace msq
