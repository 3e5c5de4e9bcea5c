// SPDX-License-Identifier: Apache-2.0
// Vector kernels for rows of sums of products of waves.
#pragma once

#include "structure/functional/row_kernels.h"

namespace msq {

/// Functions of the distance from the middle of a word of 64 samples, for the samples behind the
/// middle. Those before it have the same values, or their negatives.
struct ProductRow {
  static constexpr size_t half = 32;  ///< samples
  const float* const* even;
  size_t evens;
  const float* const* odd;
  size_t odds;
  /// First the even functions', then the odd ones': that of function f and the n-th word is
  /// coefficients[f * stride + n].
  const float* coefficients;
  size_t stride;
  float constant;
  bool is_absolute;
};

/// decide_linear() for such rows.
bool decide_products(const ProductRow& row, const LinearWords& words, const LinearResult& to);

/// A product of numbers of a word.
struct ProductFactor {
  static constexpr size_t max_parts = 4;
  float factor;
  uint32_t count;
  const float* parts[max_parts];  ///< by word
};
/// For each word, the sum of some products; reads and writes whole vectors.
void add_products(const ProductFactor* products, size_t count, size_t words, float* to);

}  // namespace msq
