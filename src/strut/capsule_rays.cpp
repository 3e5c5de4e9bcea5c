// SPDX-License-Identifier: Apache-2.0
// A capsule is the union of the balls about the points of its axis. With lengths z along the ray
// and places in the plane across it, from the ray on, the axis is z0 + s dz, p + s q for s in [0,
// 1], and the ray enters the ball about s at
//   f(s) = z0 + s dz - sqrt(R^2 - |p + s q|^2),
// which is convex. Its least value lies at s0 - dz sqrt(H / |q|^2) / |ab|, where s0 is the point
// next to the ray's line, H = R^2 - |p + s0 q|^2, or at the end next to that; it is the entry. The
// exit is found likewise.
//
// Rounding. p, q, z0 and dz are those of a capsule moved by less than 3e-6, with coordinates up
// to 8. For the capsule that is met, of a radius less by the slack, H is at least 2 r slack, and
// what is left is the error of s, to the second order of which f(s) is too large. It goes with the
// inverse cube of |q|. Where |q| is below 1e-2, axes of no length included, the balls lie within
// |q| / 2 of the middle one across the ray, and a bound by that is used, which is too low by no
// more than about |q| or the axis' length along the ray.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/capsule_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "base/mask_bits-inl.h"
#include "strut/capsule_rays.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, RayPacket::most>;
using V = hn::Vec<D>;

struct Vector {
  V x, y, z;
};
HWY_INLINE V dot(const Vector& a, const Vector& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector sub(const Vector& a, const Vector& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// a + b s
HWY_INLINE Vector add_scaled(const Vector& a, const Vector& b, V s) {
  return {hn::MulAdd(b.x, s, a.x), hn::MulAdd(b.y, s, a.y), hn::MulAdd(b.z, s, a.z)};
}
HWY_INLINE Vector load(const float* const (&v)[3], size_t i) {
  const D d;
  return {hn::LoadU(d, v[0] + i), hn::LoadU(d, v[1] + i), hn::LoadU(d, v[2] + i)};
}
HWY_INLINE Vector set(float x, float y, float z) {
  const D d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}
HWY_INLINE V clamp01(V s) {
  const D d;
  return hn::Min(hn::Max(s, hn::Zero(d)), hn::Set(d, 1.0f));
}

/// Writes the numbers of those of a chunk whose axes come within `reach` of the packet's line.
HWY_INLINE size_t near_line(const CapsuleView& capsules, size_t begin, size_t end, float reach,
                            const float (&corner)[3], const RayPacket& rays, uint32_t* found) {
  const D d;
  const Vector centre =
      set(rays.centre[0] - corner[0], rays.centre[1] - corner[1], rays.centre[2] - corner[2]);
  const Vector u = set(rays.along[0], rays.along[1], rays.along[2]);
  const V most = hn::Set(d, reach * reach), tiny = hn::Set(d, 1e-30f);
  size_t count = 0;
  for (size_t i = begin; i < end; i += hn::Lanes(d)) {
    const Vector w = sub(load(capsules.a, i), centre), ab = load(capsules.ab, i);
    const Vector p = add_scaled(w, u, hn::Neg(dot(w, u)));
    const Vector q = add_scaled(ab, u, hn::Neg(dot(ab, u)));
    const V s = clamp01(hn::Div(hn::Neg(dot(p, q)), hn::Max(dot(q, q), tiny)));
    const Vector v = add_scaled(p, q, s);
    uint64_t bits = bits_of(d, hn::Le(dot(v, v), most));
    if (end - i < hn::Lanes(d)) bits &= (uint64_t{1} << (end - i)) - 1;
    for (; bits; bits &= bits - 1)
      found[count++] = static_cast<uint32_t>(i + static_cast<size_t>(std::countr_zero(bits)));
  }
  return count;
}

template <bool kStarts>
HWY_INLINE void meet(const CapsuleView& capsules, const uint32_t* chosen, size_t chosen_count,
                     float radius, const float (&corner)[3], const RayPacket& rays,
                     PacketHits& hits) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const V r2 = hn::Set(d, radius * radius), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V none = hn::Set(d, std::numeric_limits<float>::infinity());
  constexpr float least_across = 1.0f / 1600, least_squared = 1e-10f;  // of |q|^2 / |ab|^2, |ab|^2
  for (size_t lane = 0; lane < rays.count; lane += hn::Lanes(d)) {
    const Vector o = {hn::Sub(hn::Load(d, rays.origin[0] + lane), hn::Set(d, corner[0])),
                      hn::Sub(hn::Load(d, rays.origin[1] + lane), hn::Set(d, corner[1])),
                      hn::Sub(hn::Load(d, rays.origin[2] + lane), hn::Set(d, corner[2]))};
    const Vector u = {hn::Load(d, rays.direction[0] + lane), hn::Load(d, rays.direction[1] + lane),
                      hn::Load(d, rays.direction[2] + lane)};
    const V from = hn::Load(d, rays.from + lane), to = hn::Load(d, rays.to + lane);
    V first = hn::Load(d, hits.first + lane), second = hn::Load(d, hits.second + lane);
    auto id = hn::Load(du, hits.id + lane);
    for (size_t n = 0; n < chosen_count; ++n) {
      const size_t i = chosen[n];
      const Vector a = set(capsules.a[0][i], capsules.a[1][i], capsules.a[2][i]);
      const Vector ab = set(capsules.ab[0][i], capsules.ab[1][i], capsules.ab[2][i]);
      const Vector w = sub(a, o);
      const V z0 = dot(w, u), dz = dot(ab, u);
      const Vector p = add_scaled(w, u, hn::Neg(z0)), q = add_scaled(ab, u, hn::Neg(dz));
      const V qq = dot(q, q), ll = hn::Max(dot(ab, ab), hn::Set(d, least_squared));
      const V inverse = hn::Div(one, hn::Max(qq, hn::Set(d, 1e-12f)));
      const V s0 = hn::Mul(hn::Neg(dot(p, q)), inverse);
      const Vector across = add_scaled(p, q, s0);
      const V room = hn::Sub(r2, dot(across, across));
      const auto is_small = hn::Lt(qq, hn::Mul(ll, hn::Set(d, least_across)));
      auto met = hn::Or(hn::Ge(room, zero), is_small);
      if (hn::AllFalse(d, met)) continue;
      const V shift = hn::Mul(dz, hn::Sqrt(hn::Mul(hn::Max(room, zero), hn::Div(inverse, ll))));
      const V s = clamp01(hn::Sub(s0, shift));
      const Vector v = add_scaled(p, q, s);
      const V under = hn::Sub(r2, dot(v, v));
      met = hn::And(met, hn::Or(hn::Ge(under, zero), is_small));
      V t = hn::Sub(hn::MulAdd(s, dz, z0), hn::Sqrt(hn::Max(under, zero)));
      V exit = none;
      if constexpr (kStarts) {
        const V s_out = clamp01(hn::Add(s0, shift));
        const Vector v_out = add_scaled(p, q, s_out);
        exit = hn::Add(hn::MulAdd(s_out, dz, z0),
                       hn::Sqrt(hn::Max(hn::Sub(r2, dot(v_out, v_out)), zero)));
      }
      if (!hn::AllFalse(d, is_small)) {
        const Vector middle = add_scaled(p, q, hn::Set(d, 0.5f));
        const V nearest = hn::Max(zero, hn::Sub(hn::Sqrt(dot(middle, middle)),
                                                hn::Mul(hn::Sqrt(qq), hn::Set(d, 0.501f))));
        const V ball = hn::Sub(r2, hn::Mul(nearest, nearest));
        const V half = hn::Sqrt(hn::Max(ball, zero));
        const V low = hn::Min(z0, hn::Add(z0, dz)), high = hn::Max(z0, hn::Add(z0, dz));
        t = hn::IfThenElse(is_small, hn::Sub(low, half), t);
        exit = hn::IfThenElse(is_small, hn::Add(high, half), exit);
        met = hn::And(met, hn::Or(hn::Not(is_small), hn::Ge(ball, zero)));
      }
      t = hn::Max(t, from);
      met = hn::And(met, hn::Le(t, to));
      if constexpr (kStarts) met = hn::And(met, hn::Ge(exit, from));
      t = hn::IfThenElse(met, t, none);
      const auto is_first = hn::Lt(t, first);
      const auto own_id = hn::Set(du, capsules.ids[i]);
      const auto is_same = hn::RebindMask(d, hn::Eq(own_id, id));
      second = hn::IfThenElse(is_same, second, hn::Min(second, hn::Max(t, first)));
      id = hn::IfThenElse(hn::RebindMask(du, is_first), own_id, id);
      first = hn::Min(first, t);
    }
    hn::Store(first, d, hits.first + lane);
    hn::Store(second, d, hits.second + lane);
    hn::Store(id, du, hits.id + lane);
  }
}

void meet_list(const CapsuleView& capsules, float radius, const float (&corner)[3],
               const RayPacket& rays, PacketHits& hits) {
  constexpr size_t chunk = 256;
  uint32_t chosen[chunk];
  const float wide = radius + capsule_ray_slack, reach = wide + rays.spread;
  for (size_t begin = 0; begin < capsules.count; begin += chunk) {
    const size_t end = std::min(capsules.count, begin + chunk);
    const size_t count = near_line(capsules, begin, end, reach, corner, rays, chosen);
    if (count == 0) continue;
    if (rays.starts)
      meet<true>(capsules, chosen, count, wide, corner, rays, hits);
    else
      meet<false>(capsules, chosen, count, wide, corner, rays, hits);
  }
}

size_t near_list(const CapsuleView& capsules, float radius, const float (&corner)[3],
                 const RayPacket& rays, uint32_t* found) {
  return near_line(capsules, 0, capsules.count, radius + capsule_ray_slack + rays.spread, corner,
                   rays, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(meet_list);
HWY_EXPORT(near_list);

void PacketHits::clear() {
  std::fill_n(first, RayPacket::most, std::numeric_limits<float>::infinity());
  std::fill_n(second, RayPacket::most, std::numeric_limits<float>::infinity());
  std::fill_n(id, RayPacket::most, UINT32_MAX);
}

void meet_capsules(const CapsuleView& capsules, float radius, const float (&corner)[3],
                   const RayPacket& rays, PacketHits& hits) {
  HWY_DYNAMIC_DISPATCH(meet_list)(capsules, radius, corner, rays, hits);
}

size_t near_capsules(const CapsuleView& capsules, float radius, const float (&corner)[3],
                     const RayPacket& rays, uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(near_list)(capsules, radius, corner, rays, found);
}

}  // namespace msq
#endif
