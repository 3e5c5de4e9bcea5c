// SPDX-License-Identifier: Apache-2.0
// The angles of samples in rows that run along an axis of a functional structure's grid. Each
// depends on one coordinate of the sample, to the last bit.
#pragma once

#include <vector>

#include "structure/functional/functional.h"

namespace msq {

struct RowAngles {
  RowAngles(const Functional& structure, const RowBlock& block);

  /// By axis of the samples: of the columns of all words, of the block's rows, of its layers.
  /// Padded for batches.
  std::vector<double> of[3];

  /// Words of a row after which its angles repeat; all of them if they do not.
  size_t period(const SampleGrid& grid) const;
};

}  // namespace msq
