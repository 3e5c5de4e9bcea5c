// SPDX-License-Identifier: Apache-2.0
// The sines and cosines of waves at one sample of each word of a row that is oblique to a
// functional structure's grid.
//
// The angles from sample to sample, from word to word and from row to row are the same all over a
// block. So the addition theorems give the sines and cosines at all words of a group of rows from
// those at one sample, in double precision.
#pragma once

#include <array>
#include <vector>

#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"
#include "structure/functional/wave_products.h"

namespace msq {

class TurnedStarts {
 public:
  using Part = WaveProducts::Part;

  /// `place`: which sample of a word; 31.5 is the middle.
  TurnedStarts(const Functional& structure, const RowBlock& block, double place);

  /// Finds them for the listed words. The rows of a layer of a group come in order.
  void find(const RowGroup& group, size_t row, const std::vector<uint32_t>& words);
  /// A wave's sine or cosine at each listed word. Stays where it is.
  const float* of(Part part) const { return starts_.data() + part * stride(); }
  /// From one part to the next.
  size_t stride() const { return block_.row_words() + batch_padding; }

  /// The sine or cosine of a wave's angle between samples of a row (axis 0), or rows (axis 1), that
  /// are so far apart.
  double step(Part part, int axis, double samples) const;
  /// Bounds the error of the angles.
  double angle_error() const;

 private:
  const Functional& structure_;
  const TrigonometricForm& form_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  /// Per wave: cosines, then sines, of the angles from the first of the listed words to each.
  std::vector<double> word_steps_;
  /// Per wave: cosine and sine of the angle between rows of a group that are so far apart. And sine
  /// and cosine at the first listed word of the group's first row in the layer.
  std::vector<std::array<double, 2>> row_steps_, group_starts_;
  std::vector<float> starts_;  // per wave: sines, then cosines
};

}  // namespace msq
