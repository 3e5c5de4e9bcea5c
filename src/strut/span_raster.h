// SPDX-License-Identifier: Apache-2.0
// Struts written into bit rows as x-spans, instead of points asked one by one.
//
// A row cuts a capsule, which is convex, in one interval. The raster draws the interval's samples
// that are certainly inside a capsule thinner by a margin than any radius in its reach. Samples
// that it does not rule out of one thicker by the margin either are first compared with that one
// strut, in double precision and with the radius at the sample; only those within the margin of the
// strut's surface are left to the caller's scalar predicate. The margin exceeds, many times over,
// the rounding of the span's ends, of the sample positions and of the predicate. The result is the
// predicate's answer at every sample, bit for bit, for constant and varying radii, on every
// instruction set.
//
// Why a shell in r rather than in x: errors of a squared distance are equivalent to a tiny change
// of r everywhere, also on grazing rows, where the same errors move the span's end without bound.
#pragma once

#include <bit>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "base/vec.h"
#include "strut/raster_target.h"
#include "strut/strut_batch.h"

namespace msq {

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
  /// radius_at(p): the radius at a sample, between the bounds of the strut that reaches it.
  template <class RadiusAt>
  void add(const StrutBatch& struts, double margin, RadiusAt&& radius_at);

  /// Clears what is outside; inside(p) decides the samples in doubt.
  template <class Inside>
  void finish(const Job* job, Inside&& inside);

 private:
  struct Sample {
    uint32_t i, j, k;  // j, k from the block's first row
    friend auto operator<=>(const Sample&, const Sample&) = default;
  };

  void draw(const StrutBatch& struts, double margin);
  uint64_t* certain_row(size_t j, size_t k) {
    return certain_.data() + k * layer_words_ + j * alive_.row_words();
  }
  /// The predicate will decide it.
  void leave(Sample sample);

  RowBlock alive_;
  bool empty_ = true;
  double samples_ = 0;
  Box3 box_;
  std::vector<double> y_, z_;  // of rows and layers
  size_t layer_words_ = 0;
  std::vector<uint64_t> certain_;  // rows of the block
  DoubtfulSpans doubtful_;         // of the batch at hand
  std::vector<Sample> left_;
  size_t most_left_ = size_t{1} << 20;
};

template <class RadiusAt>
void SpanRaster::add(const StrutBatch& struts, double margin, RadiusAt&& radius_at) {
  draw(struts, margin);
  const SampleGrid& grid = *alive_.grid;
  uint32_t strut = UINT32_MAX;
  Vec3 a, ab;
  double inverse_squared = 0;
  for (const DoubtfulSpan& span : doubtful_) {
    if (span.strut != strut) {
      strut = span.strut;
      a = struts.from(strut);
      ab = struts.to(strut) - a;
      const double squared = dot(ab, ab);
      inverse_squared = squared > 0 ? 1 / squared : 0;
    }
    uint64_t* const certain = certain_row(span.j, span.k);
    const uint64_t* const alive = alive_.row(alive_.y0 + span.j, alive_.z0 + span.k);
    for (uint32_t i = span.first; i < span.first + span.count; ++i) {
      const uint64_t bit = uint64_t{1} << (i % bits_per_word);
      if (!(alive[i / bits_per_word] & ~certain[i / bits_per_word] & bit)) continue;
      const Vec3 p{grid.x(i), y_[span.j], z_[span.k]};
      const Vec3 from_a = p - a;
      const double t = std::clamp(dot(from_a, ab) * inverse_squared, 0.0, 1.0);
      const Vec3 away = from_a - ab * t;
      const double squared = dot(away, away), r = radius_at(p);
      const double thick = r + margin, thin = r - margin;
      if (squared > thick * thick) continue;
      if (thin > 0 && squared < thin * thin)
        certain[i / bits_per_word] |= bit;
      else
        leave({i, span.j, span.k});
    }
  }
}

template <class Inside>
void SpanRaster::finish(const Job* job, Inside&& inside) {
  for (size_t n = 0; n < left_.size(); ++n) {
    if (n % 256 == 0) check_cancelled(job);
    const Sample s = left_[n];
    uint64_t& word = certain_row(s.j, s.k)[s.i / bits_per_word];
    const uint64_t bit = uint64_t{1} << (s.i % bits_per_word);
    if (!(word & bit) && inside(alive_.grid->at(s.i, alive_.y0 + s.j, alive_.z0 + s.k)))
      word |= bit;
  }
  const size_t words = alive_.row_words();
  for (uint64_t k = 0; k < alive_.layers(); ++k)
    for (uint64_t j = 0; j < alive_.rows(); ++j) {
      const uint64_t* certain = certain_row(j, k);
      uint64_t* row = alive_.row(alive_.y0 + j, alive_.z0 + k);
      for (size_t w = 0; w < words; ++w) row[w] &= certain[w];
    }
}

}  // namespace msq
