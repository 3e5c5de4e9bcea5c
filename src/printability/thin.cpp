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

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

// Rows are moved by less than 64 samples. Then a word becomes a part of itself and of a neighbour;
// a neighbour beyond the row is there, too.

/// Sample i of to[w] becomes one of i + shift.
inline uint64_t moved_down(const uint64_t* row, size_t w, unsigned shift) {
  return row[w] >> shift | row[w + 1] << 1 << (bits_per_word - 1 - shift);
}
/// That of i - shift. w - 1 may be -1.
inline uint64_t moved_up(const uint64_t* row, size_t w, unsigned shift) {
  return row[w] << shift | (row - 1)[w] >> 1 >> (bits_per_word - 1 - shift);
}

/// Sample i of the row was true of samples i to i + from - 1, all of them or any, and becomes true
/// of as many as `to`.
template <bool all>
void extend_runs(uint64_t* row, size_t words, unsigned from, unsigned to) {
  for (unsigned length = from; length < to;) {
    const unsigned step = std::min(length, to - length);
    for (size_t w = 0; w < words; ++w) {  // the next word is not written yet
      if constexpr (all)
        row[w] &= moved_down(row, w, step);
      else
        row[w] |= moved_down(row, w, step);
    }
    length += step;
  }
}

/// Erosion: where discs fit that begin in rows [begin, end), which are rows of the layer.
void fit_target(const Disc& disc, const LayerRows& layer, uint64_t begin, uint64_t end,
                uint64_t* line, uint64_t* fits) {
  const size_t words = layer.words;
  uint64_t* const runs = line + 1;
  uint64_t rows_of_disc = 0;
  for (const DiscRow& row : disc)
    rows_of_disc = std::max(rows_of_disc, static_cast<uint64_t>(row.row));
  // Discs that reach beyond the last row do not fit.
  const uint64_t fit_end =
      std::clamp(layer.ny > rows_of_disc ? layer.ny - rows_of_disc : 0, begin, end);
  std::fill(fits, fits + (fit_end - begin) * words, ~uint64_t{0});
  std::fill(fits + (fit_end - begin) * words, fits + (end - begin) * words, uint64_t{0});
  if (fit_end == begin) return;
  CancelPoll poll(current_job());
  for (uint64_t j = begin; j < fit_end + rows_of_disc; ++j) {
    poll();
    const uint64_t* row = layer.rows + j * words;
    std::copy_n(row, words, runs);
    runs[words] = 0;
    unsigned length = 1;
    const bool is_empty = !any_word(row, words);
    for (const DiscRow& part : disc) {
      const auto down = static_cast<uint64_t>(part.row);
      if (!is_empty) extend_runs<true>(runs, words, length, part.length);
      length = part.length;
      if (j < begin + down || j - down >= fit_end) continue;
      uint64_t* const to = fits + (j - down - begin) * words;
      if (is_empty) {
        std::fill_n(to, words, uint64_t{0});
        continue;
      }
      const auto shift = static_cast<unsigned>(part.first);
      for (size_t w = 0; w < words; ++w) to[w] &= moved_down(runs, w, shift);
    }
  }
}

/// Dilation: the samples of rows [begin, end) of the layer that discs cover, whose places are the
/// set samples of rows [first, last); `places` has these rows.
void cover_target(const Disc& disc, const LayerRows& places, uint64_t first, uint64_t last,
                  uint64_t begin, uint64_t end, uint64_t* line, uint64_t* covered) {
  const size_t words = places.words;
  uint64_t* const runs = line + 1;
  std::fill(covered, covered + (end - begin) * words, uint64_t{0});
  CancelPoll poll(current_job());
  for (uint64_t j = first; j < last; ++j) {
    poll();
    const uint64_t* row = places.rows + (j - first) * words;
    if (!any_word(row, words)) continue;
    std::copy_n(row, words, runs);
    runs[-1] = runs[words] = 0;
    unsigned length = 1;
    // A sample is covered by the discs whose places are the samples from last to first before it.
    for (const DiscRow& part : disc) {
      extend_runs<false>(runs - 1, words + 1, length, part.length);
      length = part.length;
      const int64_t to = static_cast<int64_t>(j) + part.row;
      if (to < static_cast<int64_t>(begin) || to >= static_cast<int64_t>(end)) continue;
      const auto shift = static_cast<unsigned>(part.first + static_cast<int>(part.length) - 1);
      uint64_t* const found = covered + (static_cast<uint64_t>(to) - begin) * words;
      for (size_t w = 0; w < words; ++w) found[w] |= moved_up(runs, w, shift);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(fit_target);
HWY_EXPORT(cover_target);

namespace {

Disc sorted(Disc disc) {
  std::stable_sort(disc.begin(), disc.end(),
                   [](const DiscRow& a, const DiscRow& b) { return a.length < b.length; });
  return disc;
}

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
    disc.push_back({b, first, static_cast<unsigned>(last - first + 1)});
  }
  return sorted(std::move(disc));
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
    disc.push_back({b, -reach, static_cast<unsigned>(2 * reach + 1)});
  }
  return sorted(std::move(disc));
}

}  // namespace

ThinSamples::ThinSamples(const unsigned across[2])
    : disc_(disc_of_block(across, 1)), wide_(disc_of_block(across, 2)) {
  const auto [low, high] = std::minmax_element(
      wide_.begin(), wide_.end(), [](const DiscRow& a, const DiscRow& b) { return a.row < b.row; });
  reach_ = static_cast<size_t>(high->row - low->row);
}

void ThinSamples::find(const LayerRows& layer, uint64_t begin, uint64_t end, uint64_t* scratch,
                       uint64_t* out) const {
  int low = 0, high = 0;
  for (const DiscRow& row : wide_) {
    low = std::min(low, row.row);
    high = std::max(high, row.row);
  }
  // Rows in which discs may begin that reach into the band.
  const uint64_t first = begin - std::min(begin, static_cast<uint64_t>(high));
  const uint64_t last = std::min(layer.ny, end + static_cast<uint64_t>(-low));
  uint64_t* const fits = scratch + layer.words + 2;
  HWY_DYNAMIC_DISPATCH(fit_target)(disc_, layer, first, last, scratch, fits);
  out += begin * layer.words;
  HWY_DYNAMIC_DISPATCH(cover_target)
  (wide_, {fits, layer.words, layer.ny}, first, last, begin, end, scratch, out);
  const uint64_t* rows = layer.rows + begin * layer.words;
  for (size_t i = 0; i < (end - begin) * layer.words; ++i) out[i] = rows[i] & ~out[i];
}

OverhangSamples::OverhangSamples(double distance, const double pitch[2])
    : disc_(disc_around_sample(distance, pitch)) {}

void OverhangSamples::find(const LayerRows& layer, const uint64_t* below, uint64_t begin,
                           uint64_t end, uint64_t* scratch, uint64_t* out) const {
  uint64_t reach = 0;
  for (const DiscRow& row : disc_)
    reach = std::max(reach, static_cast<uint64_t>(std::max(row.row, 0)));
  const uint64_t first = begin - std::min(begin, reach);
  const uint64_t last = std::min(layer.ny, end + reach);
  out += begin * layer.words;
  HWY_DYNAMIC_DISPATCH(cover_target)
  (disc_, {below + first * layer.words, layer.words, layer.ny}, first, last, begin, end, scratch,
   out);
  const uint64_t* rows = layer.rows + begin * layer.words;
  for (size_t i = 0; i < (end - begin) * layer.words; ++i) out[i] = rows[i] & ~out[i];
}

}  // namespace msq
#endif
