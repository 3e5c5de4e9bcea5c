// SPDX-License-Identifier: Apache-2.0
// Thin samples of a layer: those where a disc of a given width does not fit into the solid nearby.
// Source: Serra, "Image analysis and mathematical morphology", 1982: erosion and dilation.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sample_grid.h"

namespace msq {

/// The disc has `across` samples along x and y: sample (a, b) of a block of as many samples
/// belongs to it if ((2 a + 1) / across_x - 1)^2 + ... <= 1, measured from the middle of the block
/// to the middle of the sample. It fits where all its samples are solid. A solid sample is thin if
/// it lies in no disc of sqrt(2) times the width around the middle of a disc that fits. So the
/// corners of wide rectangles are not thin.
class ThinSamples {
 public:
  static constexpr unsigned max_across = 32;

  ThinSamples(uint64_t nx, uint64_t ny, const unsigned across[2]);

  /// rows: ny rows of words_for(nx) words, 0 past nx. What is outside the grid is not solid. The
  /// result is valid until the next call.
  const uint64_t* find(const uint64_t* rows);

  static uint64_t bytes(uint64_t nx, uint64_t ny) {
    return 2 * words_for(nx) * ny * sizeof(uint64_t);
  }

 private:
  /// One row of a disc, for the disc whose block begins at sample (0, 0).
  struct Span {
    int row, first;
    unsigned length;
  };

  static std::vector<Span> spans_of(const unsigned across[2], double scale);
  void fit(const uint64_t* rows);
  void cover();

  const uint64_t ny_;
  const size_t words_;
  const std::vector<Span> disc_, wide_;
  std::vector<uint64_t> fits_;   ///< where the block of a disc that fits begins
  std::vector<uint64_t> found_;  ///< covered samples, then the thin ones
  std::vector<uint64_t> runs_;   ///< one row, with a word before and behind it
};

}  // namespace msq
