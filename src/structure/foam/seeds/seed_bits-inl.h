// SPDX-License-Identifier: Apache-2.0
// splitmix_output (base/random.h) and FoamSeeds::fraction in vectors, with the same bits. Included
// once for each instruction set. Not for HWY_SCALAR, which has no lanes of half the width.
#if defined(MSQ_STRUCTURE_FOAM_SEEDS_SEED_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_SEEDS_SEED_BITS_INL_H
#undef MSQ_STRUCTURE_FOAM_SEEDS_SEED_BITS_INL_H
#else
#define MSQ_STRUCTURE_FOAM_SEEDS_SEED_BITS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Low halves of the products; few instruction sets have this for 64 bits.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D> >
HWY_INLINE V multiply_low(D /*d*/, V a, V b) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RepartitionToNarrow<D> half;
  const auto low_a = hn::BitCast(half, a), high_a = hn::BitCast(half, hn::ShiftRight<32>(a));
  const auto low_b = hn::BitCast(half, b), high_b = hn::BitCast(half, hn::ShiftRight<32>(b));
  const V cross = hn::Add(hn::MulEven(low_a, high_b), hn::MulEven(high_a, low_b));
  return hn::Add(hn::MulEven(low_a, low_b), hn::ShiftLeft<32>(cross));
}

/// splitmix_output(key, n); only the low 32 bits of n count.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D> >
HWY_INLINE V seed_bits(D d, V key, V n) {
  namespace hn = hwy::HWY_NAMESPACE;
  n = hn::And(n, hn::Set(d, 0xffffffff));
  V h = hn::Add(key, multiply_low(d, n, hn::Set(d, 0x9e3779b97f4a7c15ULL)));
  h = multiply_low(d, hn::Xor(h, hn::ShiftRight<30>(h)), hn::Set(d, 0xbf58476d1ce4e5b9ULL));
  h = multiply_low(d, hn::Xor(h, hn::ShiftRight<27>(h)), hn::Set(d, 0x94d049bb133111ebULL));
  return hn::Xor(h, hn::ShiftRight<31>(h));
}

/// FoamSeeds::fraction() of the low 21 bits. It is 2^20 + ((b - 2^20) j >> 31) for bits b and
/// jitter j: (b j + shift) >> 31 with shift = 2^51 - 2^20 j, which is not negative since j <= 2^31;
/// the sum is below 2^52. The sum with its low 31 bits cleared is the mantissa of 1 + fraction.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D> >
HWY_INLINE auto seed_fraction(D d, V bits, uint64_t jitter) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RepartitionToNarrow<D> d32;
  const hn::RebindToFloat<D> dd;
  const auto b = hn::BitCast(d32, hn::And(bits, hn::Set(d, 0x1fffff)));
  const V shift = hn::Set(d, (uint64_t{1} << 51) - (jitter << 20));
  const V sum = hn::Add(hn::MulEven(b, hn::BitCast(d32, hn::Set(d, jitter))), shift);
  const V high_bits = hn::Set(d, ~((uint64_t{1} << 31) - 1));
  const auto one = hn::Set(dd, 1.0);
  const V mantissa = hn::Or(hn::And(sum, high_bits), hn::BitCast(d, one));
  return hn::Sub(hn::BitCast(dd, mantissa), one);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
