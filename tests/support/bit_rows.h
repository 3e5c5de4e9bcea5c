// SPDX-License-Identifier: Apache-2.0
// A block of bit rows for tests, with guard words between and around the rows.
#pragma once

#include <vector>

#include "base/sample_grid.h"

namespace msq::test {

class BitRows {
 public:
  /// Rows [y0, y1) of layers [z0, z1); all samples 0.
  BitRows(const SampleGrid& grid, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) {
    block_.grid = &grid;
    block_.y0 = y0;
    block_.y1 = y1;
    block_.z0 = z0;
    block_.z1 = z1;
    const size_t words = block_.row_words();
    block_.row_stride = words + 1;
    block_.layer_stride = block_.row_stride * block_.rows() + 1;
    words_.assign(1 + block_.layer_stride * block_.layers(), guard);
    block_.words = words_.data() + 1;
    for (uint64_t k = z0; k < z1; ++k)
      for (uint64_t j = y0; j < y1; ++j)
        for (size_t w = 0; w < words; ++w) block_.row(j, k)[w] = 0;
  }
  explicit BitRows(const SampleGrid& grid) : BitRows(grid, 0, grid.ny, 0, grid.nz) {}

  const RowBlock& block() const { return block_; }
  bool get(uint64_t i, uint64_t j, uint64_t k) const {
    return block_.row(j, k)[i / bits_per_word] >> (i % bits_per_word) & 1;
  }
  void set(uint64_t i, uint64_t j, uint64_t k) {
    block_.row(j, k)[i / bits_per_word] |= uint64_t{1} << (i % bits_per_word);
  }

  /// Words between rows that were written, plus rows with bits past the last sample.
  uint64_t damage() const {
    uint64_t count = words_[0] != guard;
    const size_t words = block_.row_words();
    const uint64_t past = block_.grid->nx % bits_per_word;
    for (uint64_t k = block_.z0; k < block_.z1; ++k) {
      for (uint64_t j = block_.y0; j < block_.y1; ++j) {
        const uint64_t* row = block_.row(j, k);
        count += row[words] != guard;
        if (past) count += row[words - 1] >> past != 0;
      }
      count += block_.row(block_.y1 - 1, k)[words + 1] != guard;
    }
    return count;
  }

 private:
  static constexpr uint64_t guard = 0xdeadbeefcafef00d;

  RowBlock block_;
  std::vector<uint64_t> words_;
};

}  // namespace msq::test
