// SPDX-License-Identifier: Apache-2.0
// The lanes of a mask as bits. Included once for each instruction set.
#if defined(MSQ_BASE_MASK_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_BASE_MASK_BITS_INL_H
#undef MSQ_BASE_MASK_BITS_INL_H
#else
#define MSQ_BASE_MASK_BITS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// Bit i is lane i; a vector has at most 64 lanes.
template <class D>
HWY_INLINE uint64_t bits_of(D d, hwy::HWY_NAMESPACE::Mask<D> mask) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_AVX2
  // Highway compresses the bits of two bytes each by PEXT, which takes a hundred cycles and more on
  // AMD's processors before Zen 3.
  if constexpr (sizeof(hn::TFromD<D>) == 2 && hn::MaxLanes(D()) == 16) {
    const hn::RebindToSigned<D> wide;
    const hn::Rebind<int8_t, D> narrow;
    const auto signs = hn::DemoteTo(narrow, hn::BitCast(wide, hn::VecFromMask(d, mask)));
    return bits_of(narrow, hn::MaskFromVec(signs));
  }
#endif
  uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  const size_t lanes = hn::Lanes(d);
  if (lanes <= 8) return bytes[0];
  if (lanes == 16) {
    uint16_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
  }
  uint64_t bits = 0;
  std::memcpy(&bits, bytes, lanes / 8);
  return bits;
}

/// The mask whose lanes are the lowest bits.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Mask<D> lanes_of(D d, uint64_t bits) {
  uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof bytes);  // the order of LoadMaskBits: the first lanes first
  return hwy::HWY_NAMESPACE::LoadMaskBits(d, bytes);
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
