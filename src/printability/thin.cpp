// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "printability/thin.cpp"
#include "printability/thin.h"

#include <algorithm>
#include <cmath>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/job.h"
#include "base/simd.h"
#include "printability/bit_row.h"

#ifndef MSQ_PRINTABILITY_LINES
#define MSQ_PRINTABILITY_LINES
namespace msq {
namespace {

/// Words of zeros on either side of a line, and most words of a vector.
constexpr size_t line_pad = 8;

/// A row of words in whole pairs of vectors.
constexpr size_t row_words(size_t words) {
  return (words + 2 * line_pad - 1) / (2 * line_pad) * (2 * line_pad);
}
/// As a line.
constexpr size_t line_words(size_t words) {
  return row_words(words) + 2 * line_pad;
}

}  // namespace
}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Rows are moved by less than 64 samples. Then a word becomes a part of itself and of a neighbour.
// Rows are worked on in lines, which have words of zeros on either side.
using Words = hn::CappedTag<uint64_t, line_pad>;
using WordsV = hn::Vec<Words>;

/// Sample i becomes one of i + shift; `next` has the words after.
HWY_INLINE WordsV moved_down(WordsV word, WordsV next, int shift) {
  return hn::Or(hn::ShiftRightSame(word, shift),
                hn::ShiftLeftSame(hn::ShiftLeft<1>(next), 63 - shift));
}
/// Sample i becomes one of i - shift; `last` has the words before.
HWY_INLINE WordsV moved_up(WordsV word, WordsV last, int shift) {
  return hn::Or(hn::ShiftLeftSame(word, shift),
                hn::ShiftRightSame(hn::ShiftRight<1>(last), 63 - shift));
}

/// For each length of the disc, a line: whether all of the samples from a place are set, or any of
/// the places of which a sample is one. Each length has few samples more than the one before it.
/// Two vectors at a time: most of the work is to find out what to do.
template <bool all>
HWY_INLINE void make_lines(const Disc& disc, const uint64_t* line, size_t words, uint64_t* to,
                           size_t stride) {
  const Words d;
  const size_t lanes = hn::Lanes(d);
  for (size_t w = 0; w < words; w += 2 * lanes) {
    const uint64_t *const a = line + w, *const b = a + lanes;
    const WordsV word_a = hn::LoadU(d, a), word_b = hn::LoadU(d, b);
    WordsV found_a = word_a, found_b = word_b;
    const auto add = [&](WordsV moved_a, WordsV moved_b) {
      if constexpr (all) {
        found_a = hn::And(found_a, moved_a);
        found_b = hn::And(found_b, moved_b);
      } else {
        found_a = hn::Or(found_a, moved_a);
        found_b = hn::Or(found_b, moved_b);
      }
    };
    const auto add_sample = [&](int sample) {
      if (all != (sample < 0)) {
        const int down = all ? sample : -sample;
        add(moved_down(word_a, hn::LoadU(d, a + 1), down),
            moved_down(word_b, hn::LoadU(d, b + 1), down));
      } else {
        const int up = all ? -sample : sample;
        add(moved_up(word_a, hn::LoadU(d, a - 1), up), moved_up(word_b, hn::LoadU(d, b - 1), up));
      }
    };
    int begin = disc.lengths[0].first, end = begin + 1;
    if (begin != 0) {
      found_a = found_b = hn::Set(d, all ? ~uint64_t{0} : 0);
      add_sample(begin);
    }
    uint64_t* at = to + w;
    for (const Disc::Length& each : disc.lengths) {
      while (begin > each.first) add_sample(--begin);
      while (end < each.first + static_cast<int>(each.length)) add_sample(end++);
      hn::StoreU(found_a, d, at);
      hn::StoreU(found_b, d, at + lanes);
      at += stride;
    }
  }
}

/// The lines of a disc for the last rows, at least as many as it spans.
class DiscLines {
 public:
  /// Rows come in order, from the first on. lines: disc.words(words) words.
  DiscLines(const Disc& disc, size_t words, int64_t first, uint64_t* lines)
      : disc_(disc),
        words_(words),
        stride_(row_words(words)),
        stride_of_row_(disc.lengths.size() * stride_),
        lines_(lines),
        base_(first),
        last_empty_(first - 1),
        last_set_(first - max_disc_rows) {
    for (size_t i = 0; i < disc.rows.size(); ++i) {
      const auto row = static_cast<ptrdiff_t>(stride_of_row_) * disc.rows[i].row,
                 length = static_cast<ptrdiff_t>(disc.rows[i].length * stride_);
      after_[i] = row + length;
      before_[i] = length - row;
    }
  }

  /// line: null if no sample of the row is set.
  template <bool all>
  void set(int64_t row, const uint64_t* line) {
    const auto kept = static_cast<int64_t>(disc_.row_count()) - 1;
    if (row - base_ >= static_cast<int64_t>(disc_.kept_rows())) {
      std::copy(of(row - kept), of(row), lines_);
      base_ = row - kept;
    }
    if (line) {
      make_lines<all>(disc_, line, words_, of(row), stride_);
      last_set_ = row;
    } else {
      std::fill_n(of(row), stride_of_row_, uint64_t{0});
      last_empty_ = row;
    }
  }

  /// Erosion: where discs fit that begin in a row. Returns whether any does.
  bool fit(int64_t row, uint64_t* line) const {
    if (last_empty_ >= row) return false;
    const Words d;
    const size_t count = disc_.rows.size();
    const uint64_t* from = of(row);
    WordsV any = hn::Zero(d);
    for (size_t w = 0; w < words_; w += hn::Lanes(d), from += hn::Lanes(d)) {
      WordsV fits = hn::LoadU(d, from + after_[0]);
      for (size_t i = 1; i < count; ++i) fits = hn::And(fits, hn::LoadU(d, from + after_[i]));
      hn::StoreU(fits, d, line + w);
      any = hn::Or(any, fits);
    }
    return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
  }

  /// The samples of a row that no disc covers.
  void uncovered(int64_t row, const uint64_t* samples, uint64_t* out) const {
    const Words d;
    if (last_set_ < row - disc_.high) {
      std::copy_n(samples, words_, out);
      return;
    }
    const size_t count = disc_.rows.size();
    const uint64_t* from = of(row);
    const size_t lanes = hn::Lanes(d), whole = words_ / lanes * lanes;
    for (size_t w = 0; w < whole; w += lanes, from += lanes) {
      WordsV covered = hn::LoadU(d, from + before_[0]);
      for (size_t i = 1; i < count; ++i) covered = hn::Or(covered, hn::LoadU(d, from + before_[i]));
      hn::StoreU(hn::AndNot(covered, hn::LoadU(d, samples + w)), d, out + w);
    }
    for (size_t w = whole; w < words_; ++w, ++from) {
      uint64_t covered = 0;
      for (size_t i = 0; i < count; ++i) covered |= from[before_[i]];
      out[w] = samples[w] & ~covered;
    }
  }

 private:
  uint64_t* of(int64_t row) const {
    return lines_ + static_cast<size_t>(row - base_) * stride_of_row_;
  }

  const Disc& disc_;
  const size_t words_, stride_, stride_of_row_;
  uint64_t* const lines_;
  /// From a row's lines to those that the disc's rows take, of rows after it and before it.
  ptrdiff_t after_[max_disc_rows], before_[max_disc_rows];
  int64_t base_;  // first row that is kept
  int64_t last_empty_, last_set_;
};

/// Writes the samples of rows [begin, end) that no disc covers. line_of(row): the places of discs
/// in a row of the layer, as a line, or null. Rows come in order.
template <class LineOf>
HWY_INLINE void write_uncovered(const Disc& disc, const LayerRows& layer, uint64_t begin,
                                uint64_t end, uint64_t* lines, uint64_t* out, LineOf&& line_of) {
  CancelPoll poll(current_job());
  const int64_t first = static_cast<int64_t>(begin) - disc.high,
                last = static_cast<int64_t>(end) - disc.low;
  DiscLines covering(disc, layer.words, first, lines);
  for (int64_t row = first; row < last; ++row) {
    poll();
    const bool is_in_layer = row >= 0 && row < static_cast<int64_t>(layer.ny);
    covering.set<false>(row, is_in_layer ? line_of(static_cast<uint64_t>(row)) : nullptr);
    const int64_t to = row + disc.low;
    if (to < static_cast<int64_t>(begin)) continue;
    const size_t at = static_cast<size_t>(to) * layer.words;
    covering.uncovered(to, layer.rows + at, out + at);
  }
}

/// Erosion of a layer, row by row. What is written in a row is read for the next one: a processor
/// waits for words that it has just written if it reads them at another place.
class Erosion {
 public:
  Erosion(const Disc& disc, const LayerRows& layer, uint64_t first, uint64_t* scratch)
      : disc_(disc),
        layer_(layer),
        stride_(line_words(layer.words)),
        lines_(scratch + line_pad),
        places_(lines_ + 2 * stride_),
        fitting_(disc, layer.words, static_cast<int64_t>(first), scratch + 4 * stride_),
        next_(first) {
    std::fill_n(scratch, 4 * stride_, uint64_t{0});
    copy(first);
    fit(first);
  }

  /// Rows come in order, from the first on. Null: no disc begins there that fits.
  const uint64_t* row(uint64_t row) {
    fit(row + 1);
    return has_places_[row % 2] ? places_ + row % 2 * stride_ : nullptr;
  }

 private:
  void copy(uint64_t row) {
    if (row < layer_.ny)
      has_samples_[row % 2] =
          copy_row(layer_.rows + row * layer_.words, layer_.words, lines_ + row % 2 * stride_);
  }
  void fit(uint64_t row) {
    bool& has_places = has_places_[row % 2];
    has_places = false;
    // Discs that reach beyond the last row do not fit.
    const uint64_t last = row + static_cast<uint64_t>(disc_.high);
    if (last >= layer_.ny) return;
    for (; next_ <= last; ++next_) {
      copy(next_ + 1);
      fitting_.set<true>(static_cast<int64_t>(next_),
                         has_samples_[next_ % 2] ? lines_ + next_ % 2 * stride_ : nullptr);
    }
    has_places = fitting_.fit(static_cast<int64_t>(row), places_ + row % 2 * stride_);
  }

  const Disc& disc_;
  const LayerRows& layer_;
  const size_t stride_;
  uint64_t *const lines_, *const places_;  // of even and odd rows
  bool has_samples_[2] = {}, has_places_[2] = {};
  DiscLines fitting_;
  uint64_t next_;
};

void find_thin_target(const Disc& disc, const Disc& wide, const LayerRows& layer, uint64_t begin,
                      uint64_t end, uint64_t* scratch, uint64_t* out) {
  const uint64_t first = begin - std::min(begin, static_cast<uint64_t>(wide.high));
  Erosion erosion(disc, layer, first, scratch + wide.words(layer.words));
  write_uncovered(wide, layer, begin, end, scratch, out,
                  [&](uint64_t row) { return erosion.row(row); });
}

void find_overhangs_target(const Disc& disc, const LayerRows& layer, const uint64_t* below,
                           uint64_t begin, uint64_t end, uint64_t* scratch, uint64_t* out) {
  uint64_t* const line = scratch + line_pad;
  std::fill_n(scratch, line_words(layer.words), uint64_t{0});
  write_uncovered(disc, layer, begin, end, scratch + line_words(layer.words), out,
                  [&](uint64_t row) {
                    const bool any = copy_row(below + row * layer.words, layer.words, line);
                    return any ? line : nullptr;
                  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find_thin_target);
HWY_EXPORT(find_overhangs_target);

size_t Disc::words(size_t words) const {
  return (kept_rows() + 1) * lengths.size() * row_words(words);
}

void Disc::add(int row, Length length) {
  const auto at =
      std::lower_bound(lengths.begin(), lengths.end(), length,
                       [](const Length& a, const Length& b) { return a.length < b.length; });
  const auto index = static_cast<size_t>(at - lengths.begin());
  if (at == lengths.end() || at->length != length.length) {
    for (Row& each : rows) each.length += each.length >= index;
    lengths.insert(at, length);
  }
  low = rows.empty() ? row : std::min(low, row);
  high = rows.empty() ? row : std::max(high, row);
  rows.push_back({row, index});
}

void Disc::move(int column, int row) {
  for (Length& each : lengths) each.first += column;
  for (Row& each : rows) each.row += row;
  low += row;
  high += row;
}

namespace {

Disc disc_of_block(const unsigned across[2], double scale) {
  Disc disc;
  const int count[2] = {static_cast<int>(across[0]), static_cast<int>(across[1])};
  const auto square = [&](int index, int axis) {
    const double offset = (2.0 * index + 1) / count[axis] - 1;
    return offset * offset;
  };
  const double limit = scale * (1 + 1e-9);
  for (int b = -count[1]; b < 2 * count[1]; ++b) {
    int first = count[0] / 2;  // in the middle, or half a sample beyond it
    if (square(first, 0) + square(b, 1) > limit) continue;
    while (square(first - 1, 0) + square(b, 1) <= limit) --first;
    const int last = count[0] - 1 - first;
    disc.add(b, {first, static_cast<unsigned>(last - first + 1)});
  }
  return disc;
}

Disc disc_around_sample(double distance, const double pitch[2]) {
  const double limit = distance * distance * (1 + 1e-9);
  const auto square = [&](int index, int axis) {
    const double offset = index * pitch[axis];
    return offset * offset;
  };
  Disc disc;
  constexpr int most = static_cast<int>(OverhangSamples::max_reach);
  for (int b = -most; b <= most; ++b) {
    if (square(b, 1) > limit) continue;
    int reach = 0;
    while (reach < most && square(reach + 1, 0) + square(b, 1) <= limit) ++reach;
    disc.add(b, {-reach, static_cast<unsigned>(2 * reach + 1)});
  }
  return disc;
}

}  // namespace

// A place is the sample at the disc's first column and row. The block's first sample may lie
// outside the layer although the disc fits.
ThinSamples::ThinSamples(const unsigned across[2])
    : disc_(disc_of_block(across, 1)), wide_(disc_of_block(across, 2)) {
  int column = disc_.lengths[0].first;
  for (const Disc::Length& each : disc_.lengths) column = std::min(column, each.first);
  const int row = disc_.low;
  for (Disc* disc : {&disc_, &wide_}) disc->move(-column, -row);
}

void ThinSamples::find(const LayerRows& layer, uint64_t begin, uint64_t end, uint64_t* scratch,
                       uint64_t* out) const {
  HWY_DYNAMIC_DISPATCH(find_thin_target)(disc_, wide_, layer, begin, end, scratch, out);
}

size_t ThinSamples::scratch_words(size_t words) const {
  return 4 * line_words(words) + disc_.words(words) + wide_.words(words);
}

OverhangSamples::OverhangSamples(double distance, const double pitch[2])
    : disc_(disc_around_sample(distance, pitch)) {}

void OverhangSamples::find(const LayerRows& layer, const uint64_t* below, uint64_t begin,
                           uint64_t end, uint64_t* scratch, uint64_t* out) const {
  HWY_DYNAMIC_DISPATCH(find_overhangs_target)(disc_, layer, below, begin, end, scratch, out);
}

size_t OverhangSamples::scratch_words(size_t words) const {
  return line_words(words) + disc_.words(words);
}

}  // namespace msq
#endif
