// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/cap_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/lanes3-inl.h"
#include "base/simd.h"
#include "shape/cap_sums.h"
#include "shape/half_angles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using Vector = Lanes3<D>;

HWY_INLINE Vector from_point(D d, Vec3 corner, const Vector& p) {
  return subtract<D>(set_lanes(d, corner), p);
}

void sum_triangles(const CapTriangle* triangles, size_t count, double tolerance, size_t points,
                   const CapSums& sums) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for (size_t i = 0; i < points; i += hn::Lanes(d)) {
    const Vector p{hn::LoadU(d, sums.x + i), hn::LoadU(d, sums.y + i), hn::LoadU(d, sums.z + i)};
    HalfAngleLanes<D> sum(d);
    V error = zero;
    for (const CapTriangle* t = triangles; t != triangles + count; ++t) {
      const Vector a = from_point(d, t->corners[0], p), b = from_point(d, t->corners[1], p),
                   c = from_point(d, t->corners[2], p);
      const V of_a = hn::Sqrt(dot<D>(a, a)), of_b = hn::Sqrt(dot<D>(b, b)),
              of_c = hn::Sqrt(dot<D>(c, c));
      const V product = hn::Mul(hn::Mul(of_a, of_b), of_c);
      const V of_re =
          hn::MulAdd(dot<D>(a, b), of_c,
                     hn::MulAdd(dot<D>(a, c), of_b, hn::MulAdd(dot<D>(b, c), of_a, product)));
      const V of_im = dot<D>(a, cross<D>(b, c)), height = hn::Abs(of_im);

      // Over the product, 4 times the cosines of half the angles between corners: small near an
      // edge.
      const V size = hn::Add(hn::Abs(of_re), height), small = hn::Mul(product, hn::Set(d, 0x1p-46));
      const auto is_far = hn::Gt(size, hn::Mul(product, hn::Set(d, 0x1p-4)));
      error = hn::Add(error, hn::IfThenElse(is_far, hn::Set(d, 0x1p-42), hn::Div(small, size)));
      const auto is_apart = hn::Gt(hn::Mul(size, hn::Min(of_a, hn::Min(of_b, of_c))),
                                   hn::Mul(product, hn::Set(d, 32 * tolerance)));
      // The angle jumps from -2 pi to 2 pi within the triangle.
      const V thin = hn::Max(small, hn::Set(d, 2 * tolerance * t->twice_area));
      const auto is_within = hn::And(hn::Lt(of_re, zero), hn::Le(height, thin));
      error = hn::IfThenElse(hn::Or(hn::Not(is_apart), is_within), one, error);

      // Where the size is 0 nothing is known.
      sum.add(d, of_re, of_im);
    }
    hn::StoreU(sum.re, d, sums.re + i);
    hn::StoreU(sum.im, d, sums.im + i);
    hn::StoreU(sum.turns, d, sums.turns + i);
    hn::StoreU(error, d, sums.error + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(sum_triangles);

void sum_caps(const CapTriangle* triangles, size_t count, double tolerance, size_t points,
              const CapSums& sums) {
  HWY_DYNAMIC_DISPATCH(sum_triangles)(triangles, count, tolerance, points, sums);
}

}  // namespace msq
#endif  // HWY_ONCE
