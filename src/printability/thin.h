// SPDX-License-Identifier: Apache-2.0
// Discs of samples in a layer: the samples where one does not fit into the solid nearby, and those
// that are far from the solid of another layer.
// Source: Serra, "Image analysis and mathematical morphology", 1982: erosion and dilation.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sample_grid.h"

namespace msq {

/// Of a disc: sqrt(2) times 32, or 31 around one.
constexpr size_t max_disc_rows = 64;

/// Samples around a place, by rows.
struct Disc {
  /// Samples first to first + length - 1 from the place. |first| and first + length - 1 are less
  /// than 64.
  struct Length {
    int first;
    unsigned length;
  };
  struct Row {
    int row;        ///< from the place
    size_t length;  ///< which of `lengths`
  };
  std::vector<Length> lengths;  ///< in ascending order: longer ones are made from shorter ones
  std::vector<Row> rows;
  int low = 0, high = 0;  ///< least and greatest row

  /// Adds a row.
  void add(int row, Length length);
  /// Moves its samples.
  void move(int column, int row);
  size_t row_count() const { return static_cast<size_t>(high - low + 1); }
  /// Rows of a layer of which lines are kept.
  size_t kept_rows() const { return row_count() + 32; }
  /// Words that their lines take, of rows of so many words.
  size_t words(size_t words) const;
};

/// Rows of a layer, in words_for(nx) words each, 0 past nx. What is outside the grid is not set.
struct LayerRows {
  const uint64_t* rows;
  size_t words;
  uint64_t ny;
};

/// The disc has `across` samples along x and y: sample (a, b) of a block of as many samples
/// belongs to it if ((2 a + 1) / across_x - 1)^2 + ... <= 1, measured from the middle of the block
/// to the middle of the sample. It fits where all its samples are solid. A solid sample is thin if
/// it lies in no disc of sqrt(2) times the width around the middle of a disc that fits. So the
/// corners of wide rectangles are not thin.
class ThinSamples {
 public:
  static constexpr unsigned max_across = 32;

  explicit ThinSamples(const unsigned across[2]);

  /// Writes rows [begin, end) of the result to the same rows of `out`. Bands of rows may be found
  /// at the same time. scratch: scratch_words() words.
  void find(const LayerRows& layer, uint64_t begin, uint64_t end, uint64_t* scratch,
            uint64_t* out) const;

  size_t scratch_words(size_t words) const;

 private:
  Disc disc_, wide_;
};

/// Solid samples with none below them and none near that: sample (a, b) of the layer below is near
/// if (a pitch_x)^2 + (b pitch_y)^2 <= distance^2 from there.
class OverhangSamples {
 public:
  static constexpr unsigned max_reach = 31;

  /// The distance is at most max_reach pitches.
  OverhangSamples(double distance, const double pitch[2]);

  /// As ThinSamples::find().
  void find(const LayerRows& layer, const uint64_t* below, uint64_t begin, uint64_t end,
            uint64_t* scratch, uint64_t* out) const;

  size_t scratch_words(size_t words) const;

 private:
  Disc disc_;
};

}  // namespace msq
