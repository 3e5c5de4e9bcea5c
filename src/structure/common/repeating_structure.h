// SPDX-License-Identifier: Apache-2.0
// Structures whose rows of samples repeat where cells are a whole number of rows high.
#pragma once

#include <cstdint>

#include "base/job.h"
#include "base/sample_grid.h"
#include "structure/common/row_flips.h"

namespace msq {

class RepeatingStructure {
 public:
  virtual ~RepeatingStructure() = default;

  /// The least number of rows after which the membership of the samples of rows [y0, y1) repeats,
  /// in any layer, except for flips. At most half of the rows; 0: none is known.
  virtual uint64_t row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const = 0;
  /// As Structure::keep_rows(), of a period of rows. The samples that are alive are so in all rows
  /// up to `end`. Adds those whose membership differs from that of the row of the block that they
  /// repeat, each once. The block has one layer.
  virtual void keep_repeated_rows(const RowBlock& block, uint64_t end, RowFlips& flips,
                                  const Job* job) const = 0;
};

}  // namespace msq
