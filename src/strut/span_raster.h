// SPDX-License-Identifier: Apache-2.0
// Struts written into bit rows as x-spans, instead of points asked one by one.
//
// A row cuts a capsule, which is convex, in one interval. The raster writes two: of a capsule
// thinner by a margin than any radius in its reach, whose samples are certainly inside, and of one
// thicker by the margin, beyond which samples are certainly outside. The margin exceeds, many times
// over, the rounding of the span's ends, of the sample positions and of the scalar predicate, so
// what lies between the two spans, and only that, is in doubt; the caller's scalar predicate
// decides it. The result is the predicate's answer at every sample, bit for bit, for constant and
// varying radii, on every instruction set.
//
// Why a shell in r rather than in x: errors of a squared distance are equivalent to a tiny change
// of r everywhere, also on grazing rows, where the same errors move the span's end without bound.
#pragma once

#include <bit>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "base/vec.h"

namespace msq {

/// A strut with the least and greatest radius, margins not included, at points in its reach.
struct RasterStrut {
  Vec3 a, b;
  double low, high;
};

class SpanRaster {
 public:
  /// `alive`: the rows to restrict.
  explicit SpanRaster(const RowBlock& alive);

  /// Bounding box of the samples that are alive. Struts out of its reach may be left out.
  const Box3& box() const { return box_; }
  bool empty() const { return empty_; }
  /// Samples in the box.
  double samples() const { return samples_; }

  /// `margin`: at least the error of positions, struts and predicate, in model units.
  void add(const RasterStrut* struts, size_t count, double margin);

  /// Clears what is outside; inside(p) decides the samples in doubt.
  template <class Inside>
  void finish(const Job* job, Inside&& inside);

 private:
  RowBlock alive_;
  bool empty_ = true;
  double samples_ = 0;
  Box3 box_;
  std::vector<double> y_, z_;              // of rows and layers
  std::vector<uint64_t> certain_, doubt_;  // rows of the block, tightly packed
};

template <class Inside>
void SpanRaster::finish(const Job* job, Inside&& inside) {
  const size_t words = alive_.row_words();
  for (uint64_t k = alive_.z0; k < alive_.z1; ++k) {
    check_cancelled(job);
    for (uint64_t j = alive_.y0; j < alive_.y1; ++j) {
      const size_t at = ((k - alive_.z0) * alive_.rows() + (j - alive_.y0)) * words;
      uint64_t* row = alive_.row(j, k);
      for (size_t w = 0; w < words; ++w) {
        const uint64_t certain = certain_[at + w];
        uint64_t kept = row[w] & certain;
        for (uint64_t rest = row[w] & doubt_[at + w] & ~certain; rest; rest &= rest - 1) {
          const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
          if (inside(alive_.grid->at(w * bits_per_word + bit, j, k))) kept |= uint64_t{1} << bit;
        }
        row[w] = kept;
      }
    }
  }
}

}  // namespace msq
