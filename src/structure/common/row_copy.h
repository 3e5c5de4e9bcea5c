// SPDX-License-Identifier: Apache-2.0
// Rows of structures that are made of others, each of which clears the bits of its own copy.
#pragma once

#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "base/sample_grid.h"

namespace msq {

/// A copy of a block of rows, in memory of its own.
class RowCopy {
 public:
  explicit RowCopy(const RowBlock& original);

  const RowBlock& block() const { return block_; }

 private:
  const Borrowed<std::vector<uint64_t>> words_;
  RowBlock block_;
};

/// Calls change(a, b) for the words of two blocks of the same rows.
template <class Change>
void for_each_word(const RowBlock& one, const RowBlock& other, Change&& change) {
  const size_t words = one.row_words();
  for (uint64_t k = one.z0; k < one.z1; ++k)
    for (uint64_t j = one.y0; j < one.y1; ++j) {
      uint64_t *a = one.row(j, k), *b = other.row(j, k);
      for (size_t w = 0; w < words; ++w) change(a[w], b[w]);
    }
}

}  // namespace msq
