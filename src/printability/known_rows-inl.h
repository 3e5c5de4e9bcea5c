// SPDX-License-Identifier: Apache-2.0
// Finds, in a row, the runs of the component that is known, by vectors of words. Included once for
// each instruction set.
#if defined(MSQ_PRINTABILITY_KNOWN_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_PRINTABILITY_KNOWN_ROWS_INL_H
#undef MSQ_PRINTABILITY_KNOWN_ROWS_INL_H
#else
#define MSQ_PRINTABILITY_KNOWN_ROWS_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "printability/bit_row.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint64_t, 8>;
using WordsV = hn::Vec<Words>;

HWY_INLINE bool is_zero(WordsV v) {
  const Words d;
  return hn::AllTrue(d, hn::Eq(v, hn::Zero(d)));
}

/// The runs within words that hold seeds, which are a subset of their bits.
HWY_INLINE WordsV filled(WordsV words, WordsV seeds) {
  // As filled_up(). Then downwards: most runs are little longer than in the layer below.
  WordsV found = hn::Or(hn::AndNot(hn::Add(words, seeds), words), seeds);
  found = hn::Or(found, hn::And(words, hn::ShiftRight<1>(found)));
  found = hn::Or(found, hn::And(words, hn::ShiftRight<1>(found)));
  if (HWY_LIKELY(is_zero(hn::AndNot(found, hn::And(words, hn::ShiftRight<1>(found))))))
    return found;
  WordsV runs = words;
  const auto step = [&](WordsV moved_found, WordsV moved_runs) {
    found = hn::Or(found, hn::And(runs, moved_found));
    runs = hn::And(runs, moved_runs);
  };
  step(hn::ShiftRight<1>(found), hn::ShiftRight<1>(runs));
  step(hn::ShiftRight<2>(found), hn::ShiftRight<2>(runs));
  step(hn::ShiftRight<4>(found), hn::ShiftRight<4>(runs));
  step(hn::ShiftRight<8>(found), hn::ShiftRight<8>(runs));
  step(hn::ShiftRight<16>(found), hn::ShiftRight<16>(runs));
  step(hn::ShiftRight<32>(found), hn::ShiftRight<32>(runs));
  return found;
}

/// The words before and after those of a vector.
class Neighbours {
 public:
  Neighbours() {
    const int64_t lanes = static_cast<int64_t>(hn::Lanes(Words()));
    int64_t before[8], after[8];
    for (int64_t i = 0; i < lanes; ++i) {
      before[i] = std::max<int64_t>(i - 1, 0);
      after[i] = std::min(i + 1, lanes - 1);
    }
    std::copy_n(before, lanes, before_);
    std::copy_n(after, lanes, after_);
  }

  /// Bits of other words that are next to those of `word`, words w and on of a row.
  HWY_INLINE WordsV bits([[maybe_unused]] WordsV word, const uint64_t* row, size_t words,
                         size_t w) const {
    const Words d;
    const size_t lanes = hn::Lanes(d);
    const WordsV last = hn::Set(d, w > 0 ? row[w - 1] : 0);
    const WordsV next = hn::Set(d, w + lanes < words ? row[w + lanes] : 0);
#if HWY_TARGET == HWY_SCALAR
    const WordsV before = last, after = next;
#else
    const WordsV before = hn::IfThenElse(
        hn::FirstN(d, 1), last, hn::TableLookupLanes(word, hn::SetTableIndices(d, before_)));
    const WordsV after = hn::IfThenElse(
        hn::FirstN(d, lanes - 1), hn::TableLookupLanes(word, hn::SetTableIndices(d, after_)), next);
#endif
    return hn::Or(hn::ShiftRight<bits_per_word - 1>(before),
                  hn::ShiftLeft<bits_per_word - 1>(after));
  }

 private:
  int64_t before_[8], after_[8];
};

/// Samples of the row `beside`, and of its neighbours with corners, for a vector of words.
template <bool corners>
HWY_INLINE WordsV touching(const Neighbours& neighbours, const uint64_t* beside, size_t words,
                           size_t w) {
  const WordsV word = hn::LoadU(Words(), beside + w);
  if constexpr (!corners) return word;
  return hn::Or(hn::Or(word, neighbours.bits(word, beside, words, w)),
                hn::Or(hn::ShiftLeft<1>(word), hn::ShiftRight<1>(word)));
}

/// Divides the bits of a row: `known` are those above or beside samples of two other rows, and of
/// the parts of their runs that lie in the same word. Returns whether there are others. The row and
/// those that are written are not the same as any other.
template <bool corners>
inline bool fill_words(const uint64_t* HWY_RESTRICT row, const uint64_t* below,
                       const uint64_t* beside, uint64_t* HWY_RESTRICT known,
                       uint64_t* HWY_RESTRICT rest, size_t words) {
  const Words d;
  const Neighbours neighbours;
  const size_t lanes = hn::Lanes(d), whole = words / lanes * lanes;
  WordsV any = hn::Zero(d);
  for (size_t w = 0; w < whole; w += lanes) {
    const WordsV word = hn::LoadU(d, row + w);
    WordsV found = filled(word, hn::And(word, hn::LoadU(d, below + w)));
    WordsV others = hn::AndNot(found, word);
    if (!is_zero(others)) {
      const WordsV seeds = hn::And(others, touching<corners>(neighbours, beside, words, w));
      found = filled(word, hn::Or(found, seeds));
      others = hn::AndNot(found, word);
    }
    hn::StoreU(found, d, known + w);
    hn::StoreU(others, d, rest + w);
    any = hn::Or(any, others);
  }
  uint64_t any_tail = 0;
  for (size_t w = whole; w < words; ++w) {
    const uint64_t seeds = below[w] | (corners ? spread_word(beside, words, w) : beside[w]);
    known[w] = filled_down(row[w], filled_up(row[w], row[w] & seeds));
    rest[w] = row[w] & ~known[w];
    any_tail |= rest[w];
  }
  return any_tail != 0 || !is_zero(any);
}

/// Adds to `known` the runs of the rest that go on in another word where they are known, or that
/// are beside samples of a row, which may be null. Before, fill_words() has been there. Returns
/// whether others are left.
template <bool corners>
inline bool extend_row(const uint64_t* HWY_RESTRICT row, const uint64_t* HWY_RESTRICT beside,
                       uint64_t* HWY_RESTRICT known, uint64_t* HWY_RESTRICT rest, size_t words) {
  const Words d;
  const Neighbours neighbours;
  const size_t lanes = hn::Lanes(d), whole = words / lanes * lanes;
  for (;; beside = nullptr) {
    WordsV any = hn::Zero(d), more = hn::Zero(d);
    for (size_t w = 0; w < whole; w += lanes) {
      const WordsV word = hn::LoadU(d, row + w), here = hn::LoadU(d, known + w);
      WordsV seeds = neighbours.bits(here, known, words, w);
      if (beside) seeds = hn::Or(seeds, touching<corners>(neighbours, beside, words, w));
      const WordsV left = hn::LoadU(d, rest + w);
      seeds = hn::And(seeds, left);
      if (is_zero(seeds)) {
        any = hn::Or(any, left);
        continue;
      }
      const WordsV found = filled(word, hn::Or(here, seeds));
      const WordsV others = hn::AndNot(found, word);
      hn::StoreU(found, d, known + w);
      hn::StoreU(others, d, rest + w);
      any = hn::Or(any, others);
      more = hn::Or(more, seeds);
    }
    uint64_t any_tail = 0, more_tail = 0;
    for (size_t w = whole; w < words; ++w) {
      uint64_t seeds = w > 0 ? known[w - 1] >> (bits_per_word - 1) : 0;
      if (w + 1 < words) seeds |= known[w + 1] << (bits_per_word - 1);
      if (beside) seeds |= corners ? spread_word(beside, words, w) : beside[w];
      seeds &= rest[w];
      known[w] = filled_down(row[w], filled_up(row[w], known[w] | seeds));
      rest[w] = row[w] & ~known[w];
      any_tail |= rest[w];
      more_tail |= seeds;
    }
    if (!any_tail && is_zero(any)) return false;
    if (!more_tail && is_zero(more)) return true;
  }
}

/// Whether two rows have a sample in common.
inline bool any_common(const uint64_t* a, const uint64_t* b, size_t words) {
  const Words d;
  const size_t lanes = hn::Lanes(d);
  WordsV any = hn::Zero(d);
  size_t w = 0;
  for (; w + lanes <= words; w += lanes)
    any = hn::Or(any, hn::And(hn::LoadU(d, a + w), hn::LoadU(d, b + w)));
  uint64_t any_tail = 0;
  for (; w < words; ++w) any_tail |= a[w] & b[w];
  return any_tail != 0 || !is_zero(any);
}

/// Whether a sample of a row is also one of another row, or next to one.
inline bool any_next_to(const uint64_t* a, const uint64_t* b, size_t words) {
  uint64_t any = a[0] & spread_word(b, words, 0);
  for (size_t w = 1; w + 1 < words; ++w)
    any |= a[w] & (b[w] | b[w] << 1 | b[w] >> 1 | b[w - 1] >> (bits_per_word - 1) |
                   b[w + 1] << (bits_per_word - 1));
  if (words > 1) any |= a[words - 1] & spread_word(b, words, words - 1);
  return any != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();
#endif
