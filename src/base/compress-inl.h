// SPDX-License-Identifier: Apache-2.0
// Moves the lanes of a mask to the front of vectors. Included once for each instruction set.
#if defined(MSQ_BASE_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_BASE_COMPRESS_INL_H
#undef MSQ_BASE_COMPRESS_INL_H
#else
#define MSQ_BASE_COMPRESS_INL_H
#endif

#include <hwy/highway.h>

#include "base/mask_bits-inl.h"

#ifndef MSQ_BASE_COMPRESS_TABLE
#define MSQ_BASE_COMPRESS_TABLE
#include <array>
#include <cstdint>
namespace msq {

/// For each mask of eight lanes: the indices of its lanes, then arbitrary ones.
inline constexpr auto compress_8_lanes = [] {
  std::array<std::array<uint8_t, 8>, 256> table{};
  for (size_t mask = 0; mask < 256; ++mask)
    for (uint8_t lane = 0, n = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table[mask][n++] = lane;
  return table;
}();

}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// hwy::Compress for several vectors of 32-bit lanes and one mask. The caller stores the results: a
/// compressing store to memory is microcode on some processors.
template <class D>
class Compression {
 public:
#if HWY_TARGET == HWY_AVX2
  // The Highway of Debian 12 copies its table for 8 lanes to the stack at each use.
  explicit HWY_INLINE Compression(hwy::HWY_NAMESPACE::Mask<D> mask)
      : order_(hwy::HWY_NAMESPACE::IndicesFromVec(
            Float(),
            hwy::HWY_NAMESPACE::PromoteTo(
                Bits(), hwy::HWY_NAMESPACE::LoadU(hwy::HWY_NAMESPACE::Rebind<uint8_t, D>(),
                                                  compress_8_lanes[bits_of(D(), mask)].data())))) {}
  template <class V>
  HWY_INLINE V operator()(V v) const {
    namespace hn = hwy::HWY_NAMESPACE;
    return hn::BitCast(hn::DFromV<V>(), hn::TableLookupLanes(hn::BitCast(Float(), v), order_));
  }

 private:
  using Float = hwy::HWY_NAMESPACE::RebindToFloat<D>;
  using Bits = hwy::HWY_NAMESPACE::RebindToUnsigned<D>;

  decltype(hwy::HWY_NAMESPACE::IndicesFromVec(Float(), hwy::HWY_NAMESPACE::Zero(Bits()))) order_;
#else
  explicit HWY_INLINE Compression(hwy::HWY_NAMESPACE::Mask<D> mask) : mask_(mask) {}
  template <class V>
  HWY_INLINE V operator()(V v) const {
    namespace hn = hwy::HWY_NAMESPACE;
    return hn::Compress(v, hn::RebindMask(hn::DFromV<V>(), mask_));
  }

 private:
  hwy::HWY_NAMESPACE::Mask<D> mask_;
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
