// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/restrict_words.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/simd.h"
#include "strut/restrict_words.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

void and_words(uint64_t* words, const uint64_t* kept, size_t count) {
  const hn::ScalableTag<uint64_t> d;
  const size_t lanes = hn::Lanes(d);
  size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    hn::StoreU(hn::And(hn::LoadU(d, words + i), hn::LoadU(d, kept + i)), d, words + i);
  for (; i < count; ++i) words[i] &= kept[i];
}

void and_periods(uint64_t* words, const uint64_t* kept, size_t period, size_t count) {
  constexpr size_t max_period = 32;
  if (period > max_period || period >= count) {
    for (size_t i = 0; i < count; i += period)
      and_words(words + i, kept, std::min(period, count - i));
    return;
  }
  const hn::ScalableTag<uint64_t> d;
  const size_t lanes = hn::Lanes(d);
  if (period == 1) {
    const auto each = hn::Set(d, kept[0]);
    size_t i = 0;
    for (; i + lanes <= count; i += lanes)
      hn::StoreU(hn::And(hn::LoadU(d, words + i), each), d, words + i);
    for (; i < count; ++i) words[i] &= kept[0];
    return;
  }
  const size_t step = lanes < period ? lanes : lanes % period;
  uint64_t wrapped[max_period + max_simd_doubles];  // words are as wide as doubles
  std::copy_n(kept, period, wrapped);
  for (size_t i = 0; i < lanes; ++i) wrapped[period + i] = wrapped[i];
  size_t i = 0, phase = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::StoreU(hn::And(hn::LoadU(d, words + i), hn::LoadU(d, wrapped + phase)), d, words + i);
    phase += step;
    phase -= phase >= period ? period : 0;
  }
  for (; i < count; ++i) words[i] &= kept[i % period];
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(and_words);
HWY_EXPORT(and_periods);

}  // namespace

void restrict_words(uint64_t* words, const uint64_t* kept, size_t count) {
  HWY_DYNAMIC_DISPATCH(and_words)(words, kept, count);
}

void restrict_words(uint64_t* words, const uint64_t* kept, size_t period, size_t count) {
  HWY_DYNAMIC_DISPATCH(and_periods)(words, kept, period, count);
}

}  // namespace msq
#endif  // HWY_ONCE
