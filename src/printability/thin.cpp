// SPDX-License-Identifier: Apache-2.0
#include "printability/thin.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "printability/bit_row.h"

namespace msq {

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

}  // namespace

std::vector<ThinSamples::Span> ThinSamples::spans_of(const unsigned across[2], double scale) {
  std::vector<Span> spans;
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
    spans.push_back({b, first, static_cast<unsigned>(last - first + 1)});
  }
  // Shorter runs first: longer ones are made from them.
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& a, const Span& b) { return a.length < b.length; });
  return spans;
}

ThinSamples::ThinSamples(uint64_t nx, uint64_t ny, const unsigned across[2])
    : ny_(ny),
      words_(words_for(nx)),
      disc_(spans_of(across, 1)),
      wide_(spans_of(across, 2)),
      fits_(words_ * ny),
      found_(words_ * ny),
      runs_(words_ + 2) {}

/// Erosion.
void ThinSamples::fit(const uint64_t* rows) {
  std::fill(fits_.begin(), fits_.end(), ~uint64_t{0});
  uint64_t* const runs = runs_.data() + 1;
  CancelPoll poll(current_job());
  for (uint64_t j = 0; j < ny_; ++j) {
    poll();
    std::copy_n(rows + j * words_, words_, runs);
    runs[words_] = 0;
    unsigned length = 1;
    for (const Span& span : disc_) {
      extend_runs<true>(runs, words_, length, span.length);
      length = span.length;
      const auto row = static_cast<uint64_t>(span.row);
      if (j < row) continue;
      const auto shift = static_cast<unsigned>(span.first);
      uint64_t* const fits = fits_.data() + (j - row) * words_;
      for (size_t w = 0; w < words_; ++w) fits[w] &= moved_down(runs, w, shift);
    }
  }
  // Rows that a disc reaches beyond.
  uint64_t rows_of_disc = 0;
  for (const Span& span : disc_)
    rows_of_disc = std::max(rows_of_disc, static_cast<uint64_t>(span.row));
  const uint64_t end = ny_ > rows_of_disc ? ny_ - rows_of_disc : 0;
  std::fill(fits_.begin() + static_cast<std::ptrdiff_t>(end * words_), fits_.end(), uint64_t{0});
}

/// Dilation.
void ThinSamples::cover() {
  std::fill(found_.begin(), found_.end(), uint64_t{0});
  uint64_t* const runs = runs_.data() + 1;
  CancelPoll poll(current_job());
  for (uint64_t j = 0; j < ny_; ++j) {
    poll();
    const uint64_t* fits = fits_.data() + j * words_;
    if (!any_word(fits, words_)) continue;
    std::copy_n(fits, words_, runs);
    runs[-1] = runs[words_] = 0;
    unsigned length = 1;
    // A sample is covered by the discs that begin at the samples from last to first before it.
    for (const Span& span : wide_) {
      extend_runs<false>(runs - 1, words_ + 1, length, span.length);
      length = span.length;
      const int64_t row = static_cast<int64_t>(j) + span.row;
      if (row < 0 || row >= static_cast<int64_t>(ny_)) continue;
      const unsigned last = static_cast<unsigned>(span.first + static_cast<int>(span.length) - 1);
      uint64_t* const found = found_.data() + static_cast<uint64_t>(row) * words_;
      for (size_t w = 0; w < words_; ++w) found[w] |= moved_up(runs, w, last);
    }
  }
}

const uint64_t* ThinSamples::find(const uint64_t* rows) {
  fit(rows);
  cover();
  for (size_t i = 0; i < found_.size(); ++i) found_[i] = rows[i] & ~found_[i];
  return found_.data();
}

}  // namespace msq
