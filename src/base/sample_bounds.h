// SPDX-License-Identifier: Apache-2.0
// Where the samples of a block of rows are.
#pragma once

#include <algorithm>
#include <bit>

#include "base/sample_grid.h"

namespace msq {

/// The least range of columns, rows and layers that has all set bits of a block.
struct SampleBounds {
  uint64_t i0 = 0, i1 = 0, j0 = 0, j1 = 0, k0 = 0, k1 = 0;  ///< first, and one past the last
};

/// False if no bit is set. Of a row, reads only the words up to the first one with a set bit from
/// either side.
inline bool find_bounds(const RowBlock& block, SampleBounds& bounds) {
  const size_t words = block.row_words();
  size_t w0 = words, w1 = 0;
  bounds = {0, 0, block.y1, block.y0, block.z1, block.z0};
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const uint64_t* row = block.row(j, k);
      size_t first = 0;
      while (first < words && !row[first]) ++first;
      if (first == words) continue;
      w0 = std::min(w0, first);
      for (size_t w = words; w > std::max(w1, first); --w)
        if (row[w - 1]) w1 = w;
      bounds.j0 = std::min(bounds.j0, j);
      bounds.j1 = std::max(bounds.j1, j + 1);
      bounds.k0 = std::min(bounds.k0, k);
      bounds.k1 = std::max(bounds.k1, k + 1);
    }
  if (w0 >= w1) return false;
  uint64_t head = 0, tail = 0;
  for (uint64_t k = bounds.k0; k < bounds.k1; ++k)
    for (uint64_t j = bounds.j0; j < bounds.j1; ++j) {
      head |= block.row(j, k)[w0];
      tail |= block.row(j, k)[w1 - 1];
    }
  bounds.i0 = w0 * bits_per_word + static_cast<unsigned>(std::countr_zero(head));
  bounds.i1 = w1 * bits_per_word - static_cast<unsigned>(std::countl_zero(tail));
  return true;
}

}  // namespace msq
