// SPDX-License-Identifier: Apache-2.0
// The kernel of CapsuleList::meet(), for kernels that contain it. Included once for each
// instruction set.
//
// A capsule is the union of the balls about the points of its axis. Take coordinates relative to
// the ray's line: z along it, and the position in the plane normal to it. The axis is then z0 + s
// dz, p + s q for s in [0, 1], and the ray enters the ball about s at
//   f(s) = z0 + s dz - sqrt(R^2 - |p + s q|^2),
// which is convex. Its minimum lies at s0 - dz sqrt(H / |q|^2) / |ab|, where s0 is the point
// nearest to the ray's line and H = R^2 - |p + s0 q|^2, or at the end nearest to that. The minimum
// is the entry. The exit is found in the same way. If |q| is tiny, the balls lie within |q| / 2 of
// the middle one across the ray, and a bound by that is used.
#if defined(MSQ_STRUT_MEET_CAPSULES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_MEET_CAPSULES_INL_H
#undef MSQ_STRUT_MEET_CAPSULES_INL_H
#else
#define MSQ_STRUT_MEET_CAPSULES_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "strut/capsule_list.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// As CapsuleList::meet().
HWY_INLINE size_t meet_capsules(const CapsuleList::Arrays& arrays, size_t begin, size_t end,
                                const CapsuleList::Ray& ray, CapsuleList::Met* met) {
  namespace hn = hwy::HWY_NAMESPACE;
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  using Vector = Lanes3<D>;
  const D d;
  const V zero = hn::Zero(d);
  const Vector o = set_lanes(d, ray.origin), u = set_lanes(d, ray.direction);
  const V radius = hn::Set(d, ray.radius), to = hn::Set(d, ray.to);
  constexpr double min_across = 1e-12;  // of |q|^2 / |ab|^2
  size_t count = 0;
  for (size_t i = begin; i < end; i += hn::Lanes(d)) {
    const auto load = [&](size_t n) HWY_ATTR { return hn::LoadU(d, arrays.of[n] + i); };
    const V own = hn::Mul(load(7), radius), squared = hn::Mul(own, own), inverse_ab = load(6);
    const Vector a{load(0), load(1), load(2)}, ab{load(3), load(4), load(5)};
    const Vector w = subtract(a, o);
    const V z0 = dot(w, u), dz = dot(ab, u);
    const Vector p = add_scaled(w, u, hn::Neg(z0)), q = add_scaled(ab, u, hn::Neg(dz));
    const V qq = dot(q, q);
    // Axes of no length have an inverse of 0.
    const auto is_small =
        hn::Or(hn::Lt(hn::Mul(qq, inverse_ab), hn::Set(d, min_across)), hn::Eq(inverse_ab, zero));
    const V inverse = hn::Div(hn::Set(d, 1), hn::IfThenElse(is_small, hn::Set(d, 1), qq));
    const V s0 = hn::Neg(hn::Mul(dot(p, q), inverse));
    const Vector across = add_scaled(p, q, s0);
    const V room = hn::Sub(squared, dot(across, across));
    auto is_met = hn::Or(hn::Ge(room, zero), is_small);
    if (hn::AllFalse(d, is_met)) continue;
    const V shift =
        hn::Mul(dz, hn::Sqrt(hn::Mul(hn::Max(room, zero), hn::Mul(inverse, inverse_ab))));
    const V s_in = clamp01(d, hn::Sub(s0, shift)), s_out = clamp01(d, hn::Add(s0, shift));
    const Vector v_in = add_scaled(p, q, s_in), v_out = add_scaled(p, q, s_out);
    const V under_in = hn::Sub(squared, dot(v_in, v_in));
    const V under_out = hn::Sub(squared, dot(v_out, v_out));
    // If the ray meets an end at all, the ball of the entry and the ball of the exit both contain
    // it. Rounding may lose either one.
    is_met =
        hn::And(is_met, hn::Or(hn::Or(hn::Ge(under_in, zero), hn::Ge(under_out, zero)), is_small));
    if (hn::AllFalse(d, is_met)) continue;
    V enter = hn::Sub(hn::Add(z0, hn::Mul(s_in, dz)), hn::Sqrt(hn::Max(under_in, zero)));
    V leave = hn::Add(hn::Add(z0, hn::Mul(s_out, dz)), hn::Sqrt(hn::Max(under_out, zero)));
    if (!hn::AllFalse(d, is_small)) {
      const Vector middle = add_scaled(p, q, hn::Set(d, 0.5));
      const V nearest = hn::Max(
          zero, hn::Sub(hn::Sqrt(dot(middle, middle)), hn::Mul(hn::Sqrt(qq), hn::Set(d, 0.51))));
      const V ball = hn::Sub(squared, hn::Mul(nearest, nearest));
      const V half = hn::Sqrt(hn::Max(ball, zero));
      const V other = hn::Add(z0, dz);
      enter = hn::IfThenElse(is_small, hn::Sub(hn::Min(z0, other), half), enter);
      leave = hn::IfThenElse(is_small, hn::Add(hn::Max(z0, other), half), leave);
      is_met = hn::And(is_met, hn::Or(hn::Not(is_small), hn::Ge(ball, zero)));
    }
    is_met = hn::And(is_met, hn::And(hn::Le(enter, to), hn::Ge(leave, zero)));
    uint64_t bits = bits_of(d, is_met);
    if (end - i < hn::Lanes(d)) bits &= (uint64_t{1} << (end - i)) - 1;
    if (!bits) continue;
    double enters[max_simd_doubles], leaves[max_simd_doubles];
    hn::StoreU(enter, d, enters);
    hn::StoreU(leave, d, leaves);
    for (; bits; bits &= bits - 1) {
      const size_t lane = static_cast<size_t>(std::countr_zero(bits));
      met[count++] = {static_cast<uint32_t>(i + lane), enters[lane], leaves[lane]};
    }
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
