// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/seeds/seed_tile.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "structure/foam/seeds/seed_tile.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

// Both kernels: splitmix_output (base/random.h) and FoamSeeds::fraction for cells first_x,
// first_x + 1, ... of a row. They may write up to a vector past `count`.
//
// fraction() is 2^20 + ((b - 2^20) j >> 31) for 21 bits b and jitter j: (b j + shift) >> 31 with
// shift = 2^51 - 2^20 j, which is not negative since j <= 2^31; the sum is below 2^52.
#if HWY_TARGET == HWY_SCALAR  // has no lanes of half the width

void seeds_of_row(uint64_t row_key, uint32_t first_x, size_t count, uint64_t jitter, float* x,
                  float* y, float* z) {
  const uint64_t shift = (uint64_t{1} << 51) - (jitter << 20);
  const auto fraction = [&](uint64_t bits) {
    const uint64_t sum = (bits & 0x1fffff) * jitter + shift;
    return static_cast<float>(sum >> 31) * 0x1p-21f;
  };
  for (size_t i = 0; i < count; ++i) {
    const uint64_t h = splitmix_output(row_key, static_cast<uint32_t>(first_x + i));
    x[i] = fraction(h);
    y[i] = fraction(h >> 21);
    z[i] = fraction(h >> 42);
  }
}

#else

/// Low halves of the products; few instruction sets have this for 64 bits.
template <class D, class V = hn::Vec<D> >
HWY_INLINE V multiply(D /*d*/, V a, V b) {
  const hn::RepartitionToNarrow<D> half;
  const auto low_a = hn::BitCast(half, a), high_a = hn::BitCast(half, hn::ShiftRight<32>(a));
  const auto low_b = hn::BitCast(half, b), high_b = hn::BitCast(half, hn::ShiftRight<32>(b));
  const V cross = hn::Add(hn::MulEven(low_a, high_b), hn::MulEven(high_a, low_b));
  return hn::Add(hn::MulEven(low_a, low_b), hn::ShiftLeft<32>(cross));
}

void seeds_of_row(uint64_t row_key, uint32_t first_x, size_t count, uint64_t jitter, float* x,
                  float* y, float* z) {
  const hn::ScalableTag<uint64_t> d;
  const hn::RepartitionToNarrow<decltype(d)> d32;
  const hn::RebindToFloat<decltype(d)> dd;
  const hn::Rebind<float, decltype(d)> df;
  const size_t lanes = hn::Lanes(d);
  const auto low_half = hn::Set(d, 0xffffffff), key = hn::Set(d, row_key);
  const auto golden = hn::Set(d, 0x9e3779b97f4a7c15ULL);
  const auto mix_1 = hn::Set(d, 0xbf58476d1ce4e5b9ULL), mix_2 = hn::Set(d, 0x94d049bb133111ebULL);
  // The sum with its low 31 bits cleared is the mantissa of 1 + fraction.
  const auto bits_21 = hn::Set(d, 0x1fffff), j = hn::Set(d, jitter);
  const auto shift = hn::Set(d, (uint64_t{1} << 51) - (jitter << 20));
  const auto high_bits = hn::Set(d, ~((uint64_t{1} << 31) - 1));
  const auto one = hn::BitCast(d, hn::Set(dd, 1.0));
  const auto fraction = [&](auto bits) {
    const auto b = hn::BitCast(d32, hn::And(bits, bits_21));
    const auto product = hn::Add(hn::MulEven(b, hn::BitCast(d32, j)), shift);
    const auto mantissa = hn::Or(hn::And(product, high_bits), one);
    return hn::DemoteTo(df, hn::Sub(hn::BitCast(dd, mantissa), hn::Set(dd, 1.0)));
  };
  auto n = hn::Add(hn::Iota(d, 0), hn::Set(d, first_x));
  const auto step = hn::Set(d, lanes);
  for (size_t i = 0; i < count; i += lanes, n = hn::Add(n, step)) {
    auto h = hn::Add(key, multiply(d, hn::And(n, low_half), golden));
    h = multiply(d, hn::Xor(h, hn::ShiftRight<30>(h)), mix_1);
    h = multiply(d, hn::Xor(h, hn::ShiftRight<27>(h)), mix_2);
    h = hn::Xor(h, hn::ShiftRight<31>(h));
    hn::StoreU(fraction(h), df, x + i);
    hn::StoreU(fraction(hn::ShiftRight<21>(h)), df, y + i);
    hn::StoreU(fraction(hn::ShiftRight<42>(h)), df, z + i);
  }
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(seeds_of_row);

void SeedTile::build(const FoamSeeds& seeds, CellIndex low, const int (&size)[3],
                     const int (&halo)[3]) {
  first_ = {low.x - halo[0], low.y - halo[1], low.z - halo[2]};
  for (int axis = 0; axis < 3; ++axis) length_[axis] = size[axis] + 2 * halo[axis];
  const size_t count = static_cast<size_t>(SeedTile::seeds(size, halo)) + 2 * max_simd_doubles;
  for (std::vector<float>& v : fraction_)
    if (v.size() < count) v.resize(count);
  // A row's last vector extends into the next row, which is written after it.
  for (int z = 0; z < length_[2]; ++z)
    for (int y = 0; y < length_[1]; ++y) {
      const size_t start = static_cast<size_t>(offset(0, y, z));
      HWY_DYNAMIC_DISPATCH(seeds_of_row)
      (seeds.row_key(first_, y, z), static_cast<uint32_t>(first_.x),
       static_cast<size_t>(length_[0]), static_cast<uint64_t>(seeds.jitter()),
       fraction_[0].data() + start, fraction_[1].data() + start, fraction_[2].data() + start);
    }
}

}  // namespace msq
#endif  // HWY_ONCE
