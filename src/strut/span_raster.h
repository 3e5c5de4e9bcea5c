// SPDX-License-Identifier: Apache-2.0
// Writes struts into bit rows as x-spans, instead of evaluating points one by one.
//
// A row cuts a capsule, which is convex, in one interval. The raster uses two shells: a capsule
// thinner by a margin than the minimum radius in its reach, and one thicker by the margin than the
// maximum. Samples inside the thin one are certainly inside, and the raster draws them. Samples
// outside the thick one are ruled out. The other samples are first compared with that one strut, in
// double precision: with bounds of the radius at the sample if it is nearly linear, then with the
// radius itself, many samples at a time. Only those within the margin of the strut's surface go to
// the caller's scalar predicate. The margin exceeds, many times over, the rounding of
// the span's ends, of the sample positions and of the predicate. So the result equals the predicate
// at every sample, bit for bit, for constant and varying radii, on every instruction set.
//
// Why a shell in r rather than in x: an error of a squared distance equals a tiny change of r
// everywhere, also on grazing rows, where the same error moves the span's end without bound.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/sample_grid.h"
#include "base/simd.h"
#include "base/vec.h"
#include "strut/raster_target.h"
#include "strut/restrict_words.h"
#include "strut/strut_batch.h"

namespace msq {

/// Which samples of rows are alive: those whose bits are set, or all, whatever the bits are.
enum class AliveRows { some, all };

class SpanRaster {
 public:
  /// The rows to restrict, or to set if all are alive.
  explicit SpanRaster(const RowBlock& rows, AliveRows alive = AliveRows::some);

  /// Bounding box of the samples that are alive. Struts that do not reach it may be left out.
  const Box3& box() const { return box_; }
  bool empty() const { return empty_; }
  /// Samples in the box.
  double samples() const { return samples_; }

  /// `margin`: at least the error of positions, struts and predicate, in model units.
  /// find_radii(points, count, radii) computes the radii at samples, between the bounds of the
  /// struts that reach them.
  template <class FindRadii>
  void add(const StrutBatch& struts, double margin, FindRadii&& find_radii);

  /// The same for solids that draw(target, doubts) draws: it sets certain samples and adds
  /// undecided ones to `doubts`. holds(solid, p) then decides one solid at a point; `solid` is a
  /// number that came with the doubt. The predicate of the whole is the union of such solids.
  template <class Draw, class Holds>
  void add_solids(double margin, Draw&& draw, Holds&& holds);
  /// The same for struts, each of one radius.
  template <class Holds>
  void add_solids(const StrutBatch& struts, double margin, Holds&& holds) {
    add_solids(
        margin,
        [&](const RasterTarget& target, DoubtfulSpans& doubts) { draw(target, struts, doubts); },
        holds);
  }

  /// Clears the samples outside. inside(p) decides the doubtful samples.
  template <class Inside>
  void finish(const Job* job, Inside&& inside);

 private:
  struct Sample {
    uint32_t i, j, k;  // j, k from the block's first row
    friend auto operator<=>(const Sample&, const Sample&) = default;
  };

  /// Doubtful spans lie anywhere in the block, so each is prefetched this many ahead.
  static constexpr size_t doubts_ahead = 8;

  RasterTarget target(double margin);
  static void draw(const RasterTarget& target, const StrutBatch& struts, DoubtfulSpans& doubts);
  /// Words of a row of the block; null if all samples are alive.
  const uint64_t* alive_row(size_t j, size_t k) const {
    return are_all_alive_ ? nullptr : rows_.row(rows_.y0 + j, rows_.z0 + k);
  }
  /// Samples of a word that are alive and not certain.
  static uint64_t open_bits(const uint64_t* alive, uint64_t certain, size_t word) {
    return (alive ? alive[word] : ~uint64_t{0}) & ~certain;
  }
  uint64_t* certain_row(size_t j, size_t k) {
    return certain_->data() + k * layer_words_ + j * rows_.row_words();
  }
  /// Samples whose radius is requested together, with their squared distance from a strut.
  struct Queried {
    static constexpr size_t capacity = 128;
    size_t count = 0;
    Vec3 points[capacity];
    double squared[capacity];
    Sample samples[capacity];
  };
  template <class FindRadii>
  void decide(Queried& queried, double margin, FindRadii& find_radii);
  /// Prefetches the first words of a doubtful span, if there is one.
  HWY_INLINE void prefetch(size_t n) {
    if (n >= doubtful_.size()) return;
    const DoubtfulSpan& span = doubtful_[n];
    const size_t word = span.first / bits_per_word;
    hwy::Prefetch(certain_row(span.j, span.k) + word);
    if (const uint64_t* alive = alive_row(span.j, span.k)) hwy::Prefetch(alive + word);
  }
  /// Leaves the sample to the predicate.
  void leave(Sample sample);

  RowBlock rows_;
  bool are_all_alive_;
  bool empty_ = true;
  double samples_ = 0;
  Box3 box_;
  std::vector<double> y_, z_;  // of rows and layers
  size_t layer_words_ = 0;
  const Borrowed<std::vector<uint64_t>> certain_;  // rows of the block
  DoubtfulSpans doubtful_;                         // of the current batch
  std::vector<Sample> left_;
  size_t max_left_ = size_t{1} << 20;
};

template <class FindRadii>
void SpanRaster::add(const StrutBatch& struts, double margin, FindRadii&& find_radii) {
  doubtful_.clear();
  draw(target(margin), struts, doubtful_);
  const SampleGrid& grid = *rows_.grid;
  Queried queried;
  uint32_t strut = UINT32_MAX;
  Vec3 a, ab, slope;
  double inverse_squared = 0;
  for (size_t n = 0; n < doubtful_.size(); ++n) {
    prefetch(n + doubts_ahead);
    const DoubtfulSpan& span = doubtful_[n];
    if (span.strut != strut) {
      strut = span.strut;
      a = struts.from(strut);
      ab = struts.to(strut) - a;
      const double squared = dot(ab, ab);
      inverse_squared = squared > 0 ? 1 / squared : 0;
      if (struts.linear) slope = struts.slope(strut);
    }
    uint64_t* const certain = certain_row(span.j, span.k);
    const uint64_t* const alive = alive_row(span.j, span.k);
    for (uint32_t i = span.first; i < span.first + span.count; ++i) {
      const uint64_t bit = uint64_t{1} << (i % bits_per_word);
      uint64_t& word = certain[i / bits_per_word];
      if (!(open_bits(alive, word, i / bits_per_word) & bit)) continue;
      const Vec3 p{grid.x(i), y_[span.j], z_[span.k]};
      const Vec3 from_a = p - a;
      const double t = std::clamp(dot(from_a, ab) * inverse_squared, 0.0, 1.0);
      const Vec3 away = from_a - ab * t;
      const double squared = dot(away, away);
      bool is_queried = true;
      if (struts.linear) {
        // Samples in the strut are in its reach, where these bounds hold. So are those within its
        // maximum radius. All outcomes are frequent: there is no branch.
        const double about = struts.at_a[strut] + dot(slope, from_a);
        const double departure = struts.departure_at(strut, from_a - ab * 0.5);
        const double thick = std::min(about + departure, struts.high[strut]) + margin;
        const double thin = std::min(about - departure, struts.high[strut]) - margin;
        const bool is_inside = (thin > 0) & (squared < thin * thin);
        word |= is_inside ? bit : 0;
        is_queried = !is_inside & !((thick < 0) | (squared > thick * thick));
      }
      queried.points[queried.count] = p;
      queried.squared[queried.count] = squared;
      queried.samples[queried.count] = {i, span.j, span.k};
      queried.count += is_queried;
      if (queried.count == Queried::capacity) decide(queried, margin, find_radii);
    }
  }
  if (queried.count > 0) decide(queried, margin, find_radii);
}

template <class FindRadii>
void SpanRaster::decide(Queried& queried, double margin, FindRadii& find_radii) {
  check_cancelled();
  double radii[Queried::capacity];
  find_radii(queried.points, queried.count, radii);
  for (size_t n = 0; n < queried.count; ++n) {
    const Sample s = queried.samples[n];
    const double thick = radii[n] + margin, thin = radii[n] - margin;
    if (queried.squared[n] > thick * thick) continue;
    uint64_t& word = certain_row(s.j, s.k)[s.i / bits_per_word];
    const uint64_t bit = uint64_t{1} << (s.i % bits_per_word);
    if (word & bit) continue;
    if (thin > 0 && queried.squared[n] < thin * thin)
      word |= bit;
    else
      leave(s);
  }
  queried.count = 0;
}

template <class Draw, class Holds>
void SpanRaster::add_solids(double margin, Draw&& draw, Holds&& holds) {
  doubtful_.clear();
  draw(target(margin), doubtful_);
  for (size_t n = 0; n < doubtful_.size(); ++n) {
    prefetch(n + doubts_ahead);
    const DoubtfulSpan& span = doubtful_[n];
    uint64_t* const certain = certain_row(span.j, span.k);
    const uint64_t* const alive = alive_row(span.j, span.k);
    for (uint32_t i = span.first; i < span.first + span.count; ++i) {
      const uint64_t bit = uint64_t{1} << (i % bits_per_word);
      if (!(open_bits(alive, certain[i / bits_per_word], i / bits_per_word) & bit)) continue;
      if (holds(span.strut, Vec3{rows_.grid->x(i), y_[span.j], z_[span.k]}))
        certain[i / bits_per_word] |= bit;
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
    if (!(word & bit) && inside(rows_.grid->at(s.i, rows_.y0 + s.j, rows_.z0 + s.k))) word |= bit;
  }
  for (uint64_t k = 0; k < rows_.layers(); ++k)
    for (uint64_t j = 0; j < rows_.rows(); ++j) {
      uint64_t* const row = rows_.row(rows_.y0 + j, rows_.z0 + k);
      if (are_all_alive_)
        std::copy_n(certain_row(j, k), rows_.row_words(), row);
      else
        restrict_words(row, certain_row(j, k), rows_.row_words());
    }
}

}  // namespace msq
