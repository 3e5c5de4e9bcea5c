// SPDX-License-Identifier: Apache-2.0
// Sines and cosines. With t the turns, less whole ones, |t| <= 1/2, let s be sqrt(2) sin(pi t) and
// c be sqrt(2) cos(pi t). Then s c is the sine of the angle, and 1 - s^2 its cosine, so no quadrant
// needs to be told from another. s / t and c are polynomials of t^2 by Remez' exchange. Their
// errors, times t of s / t, are below 2^-20 and 2^-23. Each step of Horner's scheme rounds a sum
// below 7.4, of which a factor of at most 1/4 remains: less than 9 units of u = 2^-24 in all, and
// 14 where the product is rounded, too; coefficients and the last product add 3. s and c are below
// 1.42. So the errors of s c and 1 - s^2 are below 2 * 1.42 (2^-20 + 17 u) + 3 u < 2^-17.6.
#include "structure/functional/map_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/map_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

void blend_lines(const double* low, const double* high, double fraction, size_t count,
                 float* starts, float* rises) {
  const hn::CappedTag<double, map_padding> d;
  const hn::Rebind<float, decltype(d)> single;
  const auto f = hn::Set(d, fraction);
  const auto node = [&](size_t i) HWY_ATTR {
    const auto a = hn::LoadU(d, low + i), b = hn::LoadU(d, high + i);
    return hn::Add(a, hn::Mul(f, hn::Sub(b, a)));
  };
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto first = node(i), next = node(i + 1);
    hn::StoreU(hn::DemoteTo(single, hn::Sub(first, hn::Floor(first))), single, starts + i);
    hn::StoreU(hn::DemoteTo(single, hn::Sub(next, first)), single, rises + i);
  }
}

void waves_of_words(const MapRow& row, const uint32_t* words, size_t count, const MapWave* waves,
                    size_t wave_count) {
  const hn::CappedTag<float, map_padding> d;
  const hn::RebindToSigned<decltype(d)> i32;
  const size_t lanes = hn::Lanes(d);
  const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
  // Wave by wave, so that the numbers of a wave stay in registers.
  for (size_t w = 0; w < wave_count; ++w) {
    const MapWave wave = waves[w];
    const float *const starts = row.starts[wave.axis], *const rises = row.rises[wave.axis];
    const auto frequency = set(wave.frequency);
    for (size_t n = 0; n < count; ++n)
      for (size_t i = 0; i < 64; i += lanes) {
        const size_t at = size_t{words[n]} * 64 + i, to = n * 64 + i;
        const uint32_t low = row.voxels[at], high = row.voxels[at + lanes - 1];
        const uint32_t first = std::min(low, high);
        auto start = set(starts[first]), rise = set(rises[first]);
        if (low != high) {
          const auto voxels = hn::LoadU(i32, reinterpret_cast<const int32_t*>(row.voxels + at));
          const auto lane =
              hn::IndicesFromVec(d, hn::Sub(voxels, hn::Set(i32, static_cast<int32_t>(first))));
          start = hn::TableLookupLanes(hn::LoadU(d, starts + first), lane);
          rise = hn::TableLookupLanes(hn::LoadU(d, rises + first), lane);
        }
        const auto f = hn::LoadU(d, row.fractions + at);
        const auto turns = hn::Mul(hn::MulAdd(f, rise, start), frequency);
        const auto t = hn::Sub(turns, hn::Round(turns));
        const auto z = hn::Mul(t, t);
        auto s = hn::MulAdd(z, set(-0.7843740325540814f), set(3.5947880790f));
        s = hn::MulAdd(z, s, set(-7.3074434213663f));
        s = hn::Mul(t, hn::MulAdd(z, s, set(4.44286790303364f)));
        auto c = hn::MulAdd(z, set(0.3106981923214523f), set(-1.8835629875552613f));
        c = hn::MulAdd(z, c, set(5.739461170720937f));
        c = hn::MulAdd(z, c, set(-6.9788509882409135f));
        c = hn::MulAdd(z, c, set(1.4142134965650301f));
        hn::StoreU(hn::Mul(s, c), d, wave.sines + to);
        hn::StoreU(hn::NegMulAdd(s, s, set(1)), d, wave.cosines + to);
      }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(blend_lines);
HWY_EXPORT(waves_of_words);

void blend_nodes(const double* low, const double* high, double fraction, size_t count,
                 float* starts, float* rises) {
  HWY_DYNAMIC_DISPATCH(blend_lines)(low, high, fraction, count, starts, rises);
}

void find_map_waves(const MapRow& row, const uint32_t* words, size_t count, const MapWave* waves,
                    size_t wave_count) {
  HWY_DYNAMIC_DISPATCH(waves_of_words)(row, words, count, waves, wave_count);
}

}  // namespace msq
#endif  // HWY_ONCE
