// SPDX-License-Identifier: Apache-2.0
// Rows of samples that run across a functional structure's grid.
#pragma once

#include <vector>

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
  BatchOf<double> starts_;
  BatchOf<float> values_;
  std::vector<float>
      steps_;  // per wave: 64 cosines, then 64 sines, of the angle from a first sample
  std::vector<float> waves_;     // per wave: sines, then cosines, of a batch of words
  std::vector<float> at_first_;  // per wave: sines, cosines and negated sines, by listed word
  std::vector<uint32_t> words_;  // of a group's rows, with samples alive
  std::vector<double> x_, angles_[3];
};

/// The same for any tape: all samples in double precision.
void keep_turned_rows(const Functional& structure, const RowBlock& block, const Job* job);

}  // namespace msq
