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

/// Whether any of the bits first..last, inclusive, is set.
inline bool any_bit(const uint64_t* row, uint64_t first, uint64_t last) {
  const uint64_t a = first / bits_per_word, b = last / bits_per_word;
  const uint64_t head = ~uint64_t{0} << (first % bits_per_word);
  const uint64_t tail = ~uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
  if (a == b) return (row[a] & head & tail) != 0;
  if (row[a] & head) return true;
  for (uint64_t w = a + 1; w < b; ++w)
    if (row[w]) return true;
  return (row[b] & tail) != 0;
}

/// Calls take(first, last), inclusive, for each run of set bits, in order.
template <class Take>
void for_each_run(const uint64_t* row, size_t words, Take&& take) {
  uint64_t first = 0;
  bool is_open = false;  // a run goes on from the word before
  for (size_t w = 0; w < words; ++w) {
    uint64_t word = row[w];
    const uint64_t base = w * bits_per_word;
    if (is_open) {
      const auto ones = static_cast<unsigned>(std::countr_one(word));
      if (ones == bits_per_word) continue;
      take(first, base + ones - 1);
      word &= ~uint64_t{0} << ones;
      is_open = false;
    }
    while (word) {
      const auto start = static_cast<unsigned>(std::countr_zero(word));
      const auto ones = static_cast<unsigned>(std::countr_one(word >> start));
      first = base + start;
      if (start + ones == bits_per_word) {
        is_open = true;
        break;
      }
      take(first, first + ones - 1);
      word &= ~uint64_t{0} << (start + ones);
    }
  }
  if (is_open) take(first, words * bits_per_word - 1);
}

/// Divides the bits of a row by those of another. Returns whether any are left out. No two of the
/// rows are the same.
inline bool split_row(const uint64_t* __restrict row, const uint64_t* __restrict other,
                      uint64_t* __restrict common, uint64_t* __restrict rest, size_t words) {
  uint64_t any = 0;
  for (size_t w = 0; w < words; ++w) {
    const uint64_t both = row[w] & other[w];
    common[w] = both;
    rest[w] = row[w] ^ both;
    any |= row[w] ^ both;
  }
  return any != 0;
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

/// Extends seeds, a subset of the row's bits, to the runs that hold them. rest becomes the other
/// bits; returns whether there are any.
inline bool fill_runs(const uint64_t* row, size_t words, uint64_t* seeds, uint64_t* rest) {
  uint64_t any = 0, carry = 0;
  for (size_t w = 0; w < words; ++w) {
    const uint64_t word = row[w];
    if (word != seeds[w]) {
      const uint64_t up = filled_up(word, seeds[w] | (carry & word));
      carry = up >> (bits_per_word - 1);
      seeds[w] = filled_down(word, up);
    } else {
      carry = word >> (bits_per_word - 1);
    }
    rest[w] = word & ~seeds[w];
    any |= rest[w];
  }
  if (!any) return false;
  any = 0;
  for (size_t w = words; w-- > 0;) {
    if (!rest[w]) continue;
    if (w + 1 < words && (seeds[w + 1] & 1) && rest[w] >> (bits_per_word - 1)) {
      const auto ones = static_cast<unsigned>(std::countl_one(row[w]));
      seeds[w] |= ones == bits_per_word ? ~uint64_t{0} : ~(~uint64_t{0} >> ones);
      rest[w] = row[w] & ~seeds[w];
    }
    any |= rest[w];
  }
  return any != 0;
}

/// Word w of a row together with its neighbours' bits one to the left and one to the right.
inline uint64_t spread_word(const uint64_t* row, size_t words, size_t w) {
  const uint64_t word = row[w];
  uint64_t spread = word | word << 1 | word >> 1;
  if (w > 0) spread |= row[w - 1] >> (bits_per_word - 1);
  if (w + 1 < words) spread |= row[w + 1] << (bits_per_word - 1);
  return spread;
}

inline bool any_word(const uint64_t* row, size_t words) {
  uint64_t any = 0;
  for (size_t w = 0; w < words; ++w) any |= row[w];
  return any != 0;
}

}  // namespace msq
