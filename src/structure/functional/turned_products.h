// SPDX-License-Identifier: Apache-2.0
// Rows that are oblique to a functional structure's grid, for functions that are sums of products
// of waves.
//
// By the addition theorems they are sums of functions of the distance from the middle of 64
// samples, which are the same all over a block, times coefficients of these samples
// (wave_products.cpp). Samples as far from the middle on either side share the even functions' part
// and the odd ones'.
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/functional/product_kernels.h"
#include "structure/functional/turned_row.h"
#include "structure/functional/turned_starts.h"

namespace msq {

class TurnedProducts {
 public:
  /// `starts`: at the middles of words.
  TurnedProducts(const WaveProducts& products, const RowBlock& block, const TurnedStarts& starts);

  /// Clears the bits of samples that are outside.
  void keep(const TurnedRow& row);

 private:
  /// The value of a sample of the n-th listed word, from the row's coefficients.
  float value_at(size_t n, size_t sample) const;

  const WaveProducts& products_;
  const TurnedStarts& starts_;
  /// Functions, those that are even first; coefficients by word.
  AlignedFloats functions_;
  std::vector<const float*> function_pointers_;
  size_t evens_ = 0;
  std::vector<std::vector<ProductFactor>> factors_;  // of each function's coefficient
  std::vector<float> coefficients_;
  std::vector<uint64_t> in_, doubt_, mask_;
};

}  // namespace msq
