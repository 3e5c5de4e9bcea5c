// SPDX-License-Identifier: Apache-2.0
// A row of samples that is oblique to a functional structure's grid.
#pragma once

#include <vector>

#include "structure/functional/doubtful_samples.h"
#include "structure/functional/level_bounds.h"

namespace msq {

struct TurnedRow {
  const Functional& structure;
  const RowBlock& block;
  uint64_t j, k;
  const std::vector<uint32_t>& words;  ///< of the row; the others have no samples alive
  const LevelBounds& bounds;
  double slack;  ///< bounds the error of values in single precision

  uint64_t* alive() const { return block.row(j, k); }
  /// Decides samples of a word in doubt. value_at(i): that of sample i of the word.
  template <class ValueAt>
  uint64_t decide(uint32_t word, uint64_t doubt, ValueAt&& value_at) const {
    return decide_doubtful(structure, slack, *block.grid, uint64_t{word} * bits_per_word, j, k,
                           doubt, value_at);
  }
};

}  // namespace msq
