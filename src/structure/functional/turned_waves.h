// SPDX-License-Identifier: Apache-2.0
// Rows that are oblique to a functional structure's grid, by the sines and cosines of all waves at
// all samples, in single precision.
#pragma once

#include "base/simd.h"
#include "structure/functional/turned_row.h"
#include "structure/functional/turned_starts.h"

namespace msq {

class TurnedWaves {
 public:
  /// `starts`: at the first samples of words.
  TurnedWaves(const TrigonometricForm& form, const TurnedStarts& starts);

  /// Clears the bits of samples that are outside.
  void keep(const TurnedRow& row);

 private:
  void decide(const TurnedRow& row, size_t first, size_t count);

  const TrigonometricForm& form_;
  const TurnedStarts& starts_;
  BatchOf<float> values_;
  AlignedFloats steps_;  // per wave: cosines, then sines, of angles from a word's first sample on
  AlignedFloats waves_;  // per wave: sines, then cosines, of a batch of words
};

}  // namespace msq
