// SPDX-License-Identifier: Apache-2.0
// Rows of samples that are oblique to a functional structure's grid.
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"

namespace msq {

class TurnedRows {
 public:
  TurnedRows(const Functional& structure, const RowBlock& block);

  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  void keep_group(const RowGroup& group);
  size_t padded_words() const { return block_.row_words() + batch_padding; }
  void find_angle_error();
  void find_steps();
  /// The sines and cosines of the waves at the first sample of each listed word of a row.
  void find_starts(uint64_t j, uint64_t k);
  void decide(const RowGroup& group, size_t row, size_t first, size_t count);

  const Functional& structure_;
  const TrigonometricForm& form_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  double slack_ = 0;
  LevelBounds bounds_;
  BatchOf<float> values_;
  // Per wave: the cosines, then the sines, of two sets of angles: from a word's first sample to
  // each of its samples, and from the first of the listed words to each of them.
  AlignedFloats steps_;
  std::vector<double> word_steps_;
  std::vector<float> at_first_;  // per wave: sines, then cosines, at the first sample of each word
  AlignedFloats waves_;          // per wave: sines, then cosines, of a batch of words
  std::vector<uint32_t> words_;  // of a group's rows, from the first to the last with samples alive
};

/// The same for any tape: all samples in double precision.
void keep_turned_rows(const Functional& structure, const RowBlock& block, const Job* job);

}  // namespace msq
