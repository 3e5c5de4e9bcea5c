// SPDX-License-Identifier: Apache-2.0
// Strips: rows by twos, whose runs are read from words of bits. Included once for each instruction
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

/// Two rows, of which a sample joins those above and below it.
struct Strip {
  const uint64_t *low, *high;
};

/// Strip n of a band.
inline Strip strip_of(const ComponentBand& band, const ComponentMasks& masks,
                      const ComponentMask& rows, uint64_t n) {
  const uint64_t j = band.begin + rows_of_strip * n;
  return {rows.row(j), j + 1 < band.end ? rows.row(j + 1) : masks.no_row.data()};
}

/// A strip of runs, read word by word. Which run a sample belongs to is the number of runs that
/// start up to it.
template <bool corners>
struct StripReader {
  Strip strip;
  uint32_t before = 0;  // number of the run that starts first from this word on
  uint64_t low = 0, high = 0;
  uint64_t starts = 0;                     // of runs
  uint64_t moved_low = 0, moved_high = 0;  // by one sample up

  StripReader(const Strip& of, uint32_t first) : strip(of), before(first) {}

  void read(size_t w) {
    before += count_ones(starts);
    moved_low = low >> (bits_per_word - 1);
    moved_high = high >> (bits_per_word - 1);
    low = strip.low[w];
    high = strip.high[w];
    moved_low |= low << 1;
    moved_high |= high << 1;
    if constexpr (corners)
      starts = (low | high) & ~(moved_low | moved_high);
    else
      starts = (low | high) & ~((low & moved_low) | (high & moved_high));
  }
  /// Where samples follow the last one of a run.
  uint64_t ends() const { return (moved_low | moved_high) & (starts | ~(low | high)); }
  /// The run that holds the highest of some bits of this word, which are all up to one.
  uint32_t run_at(uint64_t up_to) const { return before + count_ones(starts & up_to) - 1; }
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
size_t list_pairs(const Strip& a, uint32_t a_begin, const Strip& b, uint32_t b_begin, size_t words,
                  RunPair* pairs) {
  RunPair* to = pairs;
  StripReader<corners> of_a{a, a_begin}, of_b{b, b_begin};
  uint64_t carry = 0;
  for (size_t w = 0; w < words; ++w) {
    of_a.read(w);
    of_b.read(w);
    const uint64_t both = of_a.low & of_b.high;
    // Samples where a run of `a` and one of `b` are met first.
    uint64_t meet = both & ~(both << 1 | carry);
    carry = both >> (bits_per_word - 1);
    if constexpr (corners)
      meet |= (of_a.low & ~of_a.moved_low & of_b.moved_high & ~of_b.high) |
              (of_b.high & ~of_b.moved_high & of_a.moved_low & ~of_a.low);
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
void for_each_run_beside(const Strip& strip, uint32_t begin, const uint64_t* row,
                         const uint64_t* beside, size_t words, Take&& take) {
  if (!(corners ? any_next_to(row, beside, words) : any_common(row, beside, words))) return;
  StripReader<corners> of{strip, begin};
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
