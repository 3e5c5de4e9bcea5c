// SPDX-License-Identifier: Apache-2.0
// Searches along rays, one in each lane. Included once for each instruction set.
#if defined(MSQ_BASE_RAY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_BASE_RAY_LANES_INL_H
#undef MSQ_BASE_RAY_LANES_INL_H
#else
#define MSQ_BASE_RAY_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "base/lanes3-inl.h"
#include "base/ray.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR  // which has no such parts of vectors
/// Blocks are pairs of numbers. Of two vectors a, b: a0 b0 a2 b2, or a1 b1 a3 b3.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V even_blocks(D, V a, V b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
}
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V odd_blocks(D, V a, V b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
}
#endif

/// The searches from `lane` on. Lanes beyond the last of `count` searches repeat it.
template <class D>
struct SearchLanes {
  using V = hwy::HWY_NAMESPACE::Vec<D>;

  Lanes3<D> origin, direction;
  V from, to;

  HWY_INLINE SearchLanes(const RaySearch* searches, size_t lane, size_t count) {
    namespace hn = hwy::HWY_NAMESPACE;
    const D d;
    constexpr size_t lanes = hn::MaxLanes(D());
    static_assert(offsetof(RaySearch, from) == 6 * sizeof(double));
    static_assert(offsetof(RaySearch, to) == 7 * sizeof(double));
    const auto row = [&](size_t n) {
      return &searches[std::min(lane + n, count - 1)].ray.origin.x;
    };
#if HWY_TARGET != HWY_SCALAR
    if constexpr (lanes == 8) {
      const auto pair = [&](size_t n, V& even, V& odd) HWY_ATTR {
        const V a = hn::LoadU(d, row(n)), b = hn::LoadU(d, row(n + 1));
        even = hn::InterleaveLower(d, a, b);
        odd = hn::InterleaveUpper(d, a, b);
      };
      V even[4], odd[4];
      for (size_t n = 0; n < 4; ++n) pair(2 * n, even[n], odd[n]);
      const auto columns = [&](const V(&of)[4], V& c0, V& c2, V& c4, V& c6) HWY_ATTR {
        const V a = even_blocks(d, of[0], of[1]), b = even_blocks(d, of[2], of[3]);
        c0 = hn::ConcatLowerLower(d, b, a);
        c4 = hn::ConcatUpperUpper(d, b, a);
        const V e = odd_blocks(d, of[0], of[1]), f = odd_blocks(d, of[2], of[3]);
        c2 = hn::ConcatLowerLower(d, f, e);
        c6 = hn::ConcatUpperUpper(d, f, e);
      };
      columns(even, origin.x, origin.z, direction.y, from);
      columns(odd, origin.y, direction.x, direction.z, to);
    } else if constexpr (lanes == 4) {
      const auto columns = [&](size_t at, V& c0, V& c1, V& c2, V& c3) HWY_ATTR {
        const V a = hn::LoadU(d, row(0) + at), b = hn::LoadU(d, row(1) + at);
        const V e = hn::LoadU(d, row(2) + at), f = hn::LoadU(d, row(3) + at);
        const V ab = hn::InterleaveLower(d, a, b), ef = hn::InterleaveLower(d, e, f);
        c0 = hn::ConcatLowerLower(d, ef, ab);
        c2 = hn::ConcatUpperUpper(d, ef, ab);
        const V ab1 = hn::InterleaveUpper(d, a, b), ef1 = hn::InterleaveUpper(d, e, f);
        c1 = hn::ConcatLowerLower(d, ef1, ab1);
        c3 = hn::ConcatUpperUpper(d, ef1, ab1);
      };
      columns(0, origin.x, origin.y, origin.z, direction.x);
      columns(4, direction.y, direction.z, from, to);
    } else
#endif
    {
      HWY_ALIGN double values[8][lanes];
      for (size_t n = 0; n < hn::Lanes(d); ++n)
        for (size_t i = 0; i < 8; ++i) values[i][n] = row(n)[i];
      const auto all = [&](size_t i) HWY_ATTR { return hn::Load(d, values[i]); };
      origin = {all(0), all(1), all(2)};
      direction = {all(3), all(4), all(5)};
      from = all(6);
      to = all(7);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
