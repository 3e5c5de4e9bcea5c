// SPDX-License-Identifier: Apache-2.0
// Rows of samples that are oblique to a functional structure's grid.
#pragma once

#include <array>
#include <vector>

#include "base/simd.h"
#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"
#include "structure/functional/product_kernels.h"

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
  /// The sines and cosines of the waves at the first sample of each listed word of a row; for
  /// products, at the middle of the word.
  void find_starts(const RowGroup& group, size_t row);
  void decide(const RowGroup& group, size_t row, size_t first, size_t count);
  double step(WaveProducts::Part part, int axis, double samples) const;
  void set_up_waves();
  void set_up_products();
  void decide_products(const RowGroup& group, size_t row);
  /// The value of a sample of the n-th listed word, from the row's coefficients.
  float product_at(size_t n, size_t sample) const;
  /// Decides samples in doubt. value_at(i): that of sample i of the word, within slack_.
  template <class ValueAt>
  uint64_t held(const RowGroup& group, size_t row, uint32_t word, uint64_t doubt,
                ValueAt&& value_at) const;

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
  /// Per wave: cosine and sine of the angle between rows of a group that are so far apart. And sine
  /// and cosine at the first listed word of the group's first row in the layer.
  std::vector<std::array<double, 2>> row_steps_, group_starts_;
  std::vector<float> at_first_;  // per wave: sines, then cosines, at the first sample of each word
  AlignedFloats waves_;          // per wave: sines, then cosines, of a batch of words
  /// Of sums of products of waves: functions, those that are even first; coefficients by word.
  const WaveProducts* const products_;
  AlignedFloats functions_;
  std::vector<const float*> function_pointers_;
  size_t evens_ = 0;
  std::vector<std::vector<ProductFactor>> factors_;  // of each function's coefficient
  std::vector<float> coefficients_;
  std::vector<uint64_t> in_, doubt_, mask_;
  std::vector<uint32_t> words_;  // of a group's rows, from the first to the last with samples alive
};

/// The same for any tape: all samples in double precision.
void keep_turned_rows(const Functional& structure, const RowBlock& block, const Job* job);

}  // namespace msq
