// SPDX-License-Identifier: Apache-2.0
// Runs of set bits in rows of samples. Sample i is bit i % 64 of word i / 64; bits past the end are
// 0.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/sample_grid.h"

namespace msq {

/// Sets those of the bits first..last, inclusive, that another row has.
inline void add_bits(uint64_t* row, const uint64_t* other, uint64_t first, uint64_t last) {
  const uint64_t a = first / bits_per_word, b = last / bits_per_word;
  for (uint64_t w = a; w <= b; ++w) {
    const uint64_t from = w == a ? first % bits_per_word : 0;
    const uint64_t to = w == b ? last % bits_per_word : bits_per_word - 1;
    row[w] |= other[w] & ~uint64_t{0} << from & ~uint64_t{0} >> (bits_per_word - 1 - to);
  }
}

/// Copies a row. Returns whether any sample is set.
inline bool copy_row(const uint64_t* row, size_t words, uint64_t* to) {
  uint64_t any = 0;
  for (size_t w = 0; w < words; ++w) {
    to[w] = row[w];
    any |= row[w];
  }
  return any != 0;
}

/// Writes the samples that a row does not have. `last`: the bits of its last word.
inline void invert_row(const uint64_t* row, size_t words, uint64_t last, uint64_t* to) {
  for (size_t w = 0; w < words; ++w) to[w] = ~row[w];
  to[words - 1] &= last;
}

/// The runs of a word above its seeds, which are a subset of its bits: a sum carries from each seed
/// to the end of its run.
inline uint64_t filled_up(uint64_t word, uint64_t seeds) {
  return (word & ~(word + seeds)) | seeds;
}

/// The runs of a word below its seeds, by doubling; in words of short runs that ends soon.
inline uint64_t filled_down(uint64_t word, uint64_t seeds) {
  for (unsigned step = 1; word && step < bits_per_word; step *= 2) {
    seeds |= word & seeds >> step;
    word &= word >> step;
  }
  return seeds;
}

/// Word w of a row together with its neighbours' bits one to the left and one to the right.
inline uint64_t spread_word(const uint64_t* row, size_t words, size_t w) {
  const uint64_t word = row[w];
  uint64_t spread = word | word << 1 | word >> 1;
  if (w > 0) spread |= row[w - 1] >> (bits_per_word - 1);
  if (w + 1 < words) spread |= row[w + 1] << (bits_per_word - 1);
  return spread;
}

}  // namespace msq
