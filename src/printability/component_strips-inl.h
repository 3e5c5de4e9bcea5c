// SPDX-License-Identifier: Apache-2.0
// Strips: rows by twos, and their runs, as words of bits. Included once for each instruction
// set: counting the bits of a word is one instruction in most.
#if defined(MSQ_PRINTABILITY_COMPONENT_STRIPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_PRINTABILITY_COMPONENT_STRIPS_INL_H
#undef MSQ_PRINTABILITY_COMPONENT_STRIPS_INL_H
#else
#define MSQ_PRINTABILITY_COMPONENT_STRIPS_INL_H
#endif

#include <bit>

#include <hwy/highway.h>

#include "printability/component_band.h"
#include "printability/known_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

inline uint32_t count_ones(uint64_t word) {
  return static_cast<uint32_t>(std::popcount(word));
}

/// Calls take(bit) for each bit of a word that is set.
template <class Take>
inline void for_each_bit(uint64_t word, Take&& take) {
  for (; word; word &= word - 1) take(static_cast<unsigned>(std::countr_zero(word)));
}

/// The bits up to and with one.
inline uint64_t bits_to(unsigned bit) {
  return ~uint64_t{0} >> (bits_per_word - 1 - bit);
}

/// Two rows, of which a sample joins those above and below it, and their runs.
struct Strip {
  const uint64_t *low, *high;
  const uint64_t* starts;  ///< of runs
  uint32_t begin;          ///< the first run
};

/// Where the runs of two rows start, and the samples behind their last ones.
template <bool corners>
void find_edges(const uint64_t* low, const uint64_t* high, size_t words,
                std::vector<uint64_t>& starts, std::vector<uint64_t>& ends) {
  if (starts.size() < words) starts.resize(words);
  if (ends.size() < words) ends.resize(words);
  const auto put = [&](auto d, size_t w) HWY_ATTR {
    const auto before = [&](const uint64_t* row, auto here) HWY_ATTR {
      const auto last = w > 0 ? hn::LoadU(d, row + w - 1) : hn::Zero(d);
      return hn::Or(hn::ShiftLeft<1>(here), hn::ShiftRight<bits_per_word - 1>(last));
    };
    const auto at_low = hn::LoadU(d, low + w), at_high = hn::LoadU(d, high + w);
    const auto low_before = before(low, at_low), high_before = before(high, at_high);
    const auto any = hn::Or(at_low, at_high), any_before = hn::Or(low_before, high_before);
    const auto goes_on =
        corners ? any_before : hn::Or(hn::And(at_low, low_before), hn::And(at_high, high_before));
    hn::StoreU(hn::AndNot(goes_on, any), d, starts.data() + w);
    hn::StoreU(hn::AndNot(hn::And(any, goes_on), any_before), d, ends.data() + w);
  };
  const hn::CappedTag<uint64_t, 1> one;
  const size_t lanes = hn::Lanes(Words());
  put(one, 0);
  if (words <= lanes)
    for (size_t w = 1; w < words; ++w) put(one, w);
  else  // the last vector may overlap another
    for (size_t w = 1; w < words; w += lanes) put(Words(), std::min(w, words - lanes));
}

/// Strip n of a band; `rows` are those that the runs are of. Finds where they start.
template <bool corners>
Strip strip_of(const ComponentBand& band, const ComponentMasks& masks, const ComponentMask& rows,
               const ComponentRuns& runs, uint64_t n, std::vector<uint64_t>& starts,
               std::vector<uint64_t>& ends) {
  const uint64_t j = band.begin + rows_of_strip * n;
  const uint64_t *const low = rows.row(j), *const high = j + 1 < band.end ? rows.row(j + 1)
                                                                          : masks.no_row.data();
  find_edges<corners>(low, high, rows.words, starts, ends);
  return {low, high, starts.data(), runs.begin[n]};
}

/// The runs of a strip, read word by word. Which run a sample belongs to is the number of runs that
/// start up to it.
class RunReader {
 public:
  explicit RunReader(const Strip& of) : from_(of.starts), before_(of.begin) {}

  void read(size_t w) {
    before_ += count_ones(starts_);
    starts_ = from_[w];
  }
  /// The run that holds the highest of some bits of this word, which are all up to one.
  uint32_t run_at(uint64_t up_to) const { return before_ + count_ones(starts_ & up_to) - 1; }

 private:
  const uint64_t* from_;
  uint32_t before_;  // the run that starts first from this word on
  uint64_t starts_ = 0;
};

/// Bits of a word that are looked at together, even if fewer are set: the processor foresees loops
/// of so many better.
constexpr uint32_t at_once = 6;

/// The first sample of a run of a strip: x + 2^32 y.
inline uint64_t place_of(const Strip& strip, uint32_t first, uint32_t end, uint32_t row) {
  const size_t last = (end - 1) / bits_per_word;
  uint64_t mask = ~uint64_t{0} << first % bits_per_word;
  for (size_t w = first / bits_per_word; w <= last; ++w, mask = ~uint64_t{0}) {
    const uint64_t bits = strip.low[w] & mask;
    if (!bits) continue;
    const uint64_t x = w * bits_per_word + static_cast<uint64_t>(std::countr_zero(bits));
    if (x >= end) break;
    return uint64_t{row} << 32 | x;
  }
  return uint64_t{row + 1} << 32 | first;
}

/// Lists the pairs of runs of a strip and the strip before it that overlap or, with corners, meet
/// at one: some of them several times. There is room for one for each sample of a row, and for
/// at_once more.
template <bool corners>
size_t list_pairs(const Strip& a, const Strip& b, size_t words, RunPair* pairs) {
  RunPair* to = pairs;
  RunReader of_a(a), of_b(b);
  uint64_t carry_a = 0, carry_b = 0, carry = 0;
  for (size_t w = 0; w < words; ++w) {
    of_a.read(w);
    of_b.read(w);
    const uint64_t row_a = a.low[w], row_b = b.high[w], both = row_a & row_b;
    // Samples where a run of `a` and one of `b` are met first.
    uint64_t meet = both & ~(both << 1 | carry);
    carry = both >> (bits_per_word - 1);
    if constexpr (corners) {
      const uint64_t before_a = row_a << 1 | carry_a, before_b = row_b << 1 | carry_b;
      meet |= (row_a & ~before_a & before_b & ~row_b) | (row_b & ~before_b & before_a & ~row_a);
      carry_a = row_a >> (bits_per_word - 1);
      carry_b = row_b >> (bits_per_word - 1);
    }
    const uint32_t found = count_ones(meet);
    for (uint32_t i = 0; i < found; i += at_once)
      for (uint32_t k = i; k < i + at_once; ++k) {
        // The bits up to and with the lowest of `meet`.
        const uint64_t up_to = meet ^ (meet - 1);
        to[k] = {of_a.run_at(up_to), of_b.run_at(up_to)};
        meet &= meet - 1;
      }
    to += found;
  }
  return static_cast<size_t>(to - pairs);
}

/// Calls take(run) for runs of a strip with samples in one of its rows that are next to samples of
/// the row `beside`; for some of them several times.
template <bool corners, class Take>
void for_each_run_beside(const Strip& strip, const uint64_t* row, const uint64_t* beside,
                         size_t words, Take&& take) {
  if (!(corners ? any_next_to(row, beside, words) : any_common(row, beside, words))) return;
  RunReader of(strip);
  for (size_t w = 0; w < words; ++w) {
    of.read(w);
    const uint64_t touching = corners ? spread_word(beside, words, w) : beside[w];
    for_each_bit(row[w] & touching, [&](unsigned bit) { take(of.run_at(bits_to(bit))); });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();
#endif
