// SPDX-License-Identifier: Apache-2.0
// Thresholds in single precision on either side of the level.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "base/sample_grid.h"
#include "field/field.h"
#include "structure/functional/row_kernels.h"

namespace msq {

/// Rows [y0, y1) of layers [z0, z1) of a grid: so few that the level changes little among them.
struct RowGroup {
  uint64_t y0, y1, z0, z1;

  size_t rows() const { return (y1 - y0) * (z1 - z0); }
  uint64_t y(size_t row) const { return y0 + row % (y1 - y0); }
  uint64_t z(size_t row) const { return z0 + row / (y1 - y0); }
};
constexpr uint64_t max_group_rows = 16, max_group_layers = 8;
static_assert(max_group_rows * max_group_layers <= batch_points);

/// Let the error of a value be at most `slack`. A value of at most `low` is then at most the level,
/// and one above `high` is above the level. The bounds are for all samples if the level is
/// constant, otherwise for chunks of samples.
struct LevelBounds {
  std::vector<float> low, high;

  void set(Interval level, double slack) {
    low = {at_most(level.low - slack)};
    high = {-at_most(-level.high - slack)};
  }
  /// Sets the bounds for the listed words of a group's rows.
  void set(const Parameter& level, double slack, const SampleGrid& grid, const RowGroup& group,
           const std::vector<uint32_t>& words) {
    low.resize(words_for(grid.nx) * bits_per_word / linear_chunk);
    high.resize(low.size());
    for (uint32_t w : words)
      for (uint64_t i = w * bits_per_word; i < (w + 1) * bits_per_word; i += linear_chunk) {
        const Interval range = level.range(
            {grid.at(std::min(i, grid.nx - 1), group.y0, group.z0),
             grid.at(std::min(i + linear_chunk, grid.nx) - 1, group.y1 - 1, group.z1 - 1)});
        low[i / linear_chunk] = at_most(range.low - slack);
        high[i / linear_chunk] = -at_most(-range.high - slack);
      }
  }

 private:
  static float at_most(double v) {
    const float f = static_cast<float>(v);
    return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                      : f;
  }
};

}  // namespace msq
