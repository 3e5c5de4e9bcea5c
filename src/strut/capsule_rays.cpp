// SPDX-License-Identifier: Apache-2.0
// A capsule is the union of the balls about the points of its axis. Take coordinates relative to
// the ray: z along it, and the position in the plane normal to it. The axis is then z0 + s dz, p +
// s q for s in [0, 1], and the ray enters the ball about s at
//   f(s) = z0 + s dz - sqrt(R^2 - |p + s q|^2),
// which is convex. Its minimum lies at s0 - dz sqrt(H / |q|^2) / |ab|, where s0 is the point
// nearest to the ray's line, H = R^2 - |p + s0 q|^2, or at the end nearest to that. The minimum is
// the entry. The exit is found in the same way.
//
// Rounding. p, q, z0 and dz are those of a capsule moved by less than 3e-6, with coordinates up to
// 8. For a capsule that the ray meets, with its radius reduced by the slack, H is at least 2 r
// slack. The remaining error is that of s, and f(s) is too large by its second order. It grows with
// the inverse cube of |q|. If |q| is below 1e-2, which includes axes of length 0, the balls lie
// within |q| / 2 of the middle one across the ray. Then a bound by that is used, which is too low
// by at most about |q| or the axis' length along the ray.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/capsule_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/basis.h"
#include "base/compress-inl.h"
#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "strut/capsule_rays.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<float, RayPacket::most>;
using V = hn::Vec<D>;

using Vector = Lanes3<D>;

HWY_INLINE Vector load(const float* const (&v)[3], size_t i) {
  const D d;
  return {hn::LoadU(d, v[0] + i), hn::LoadU(d, v[1] + i), hn::LoadU(d, v[2] + i)};
}
HWY_INLINE Vector set(float x, float y, float z) {
  const D d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

/// Capsules of a chunk that rays may meet, by their numbers.
struct Chosen {
  static constexpr size_t most = 64;
  uint32_t numbers[most + capsule_padding];
  size_t count = 0;

  HWY_INLINE void add(size_t first, hn::Mask<D> which) {
    const hn::RebindToUnsigned<D> d;
    const Compression<D> order(which);
    hn::StoreU(order(hn::Iota(d, static_cast<uint32_t>(first))), d, numbers + count);
    count += hn::CountTrue(D(), which);
  }
  /// Leaves out those that were seen. Without a branch: which are is unpredictable.
  HWY_INLINE void drop_seen(const uint32_t* ids, SeenIds* seen) {
    if (!seen) return;
    size_t kept = 0;
    for (size_t n = 0; n < count; ++n) {
      const uint32_t number = numbers[n];
      numbers[kept] = number;
      kept += seen->add(ids[number]);
    }
    count = kept;
  }
  /// Moves those whose bits are set to `to`, where number 0 is `begin`.
  HWY_INLINE void move(uint64_t bits, size_t begin, Chosen& to) {
    size_t kept = 0;
    for (size_t n = 0; n < count; ++n) {
      const uint32_t number = numbers[n];
      if (bits >> number & 1)
        to.numbers[to.count++] = static_cast<uint32_t>(begin + number);
      else
        numbers[kept++] = number;
    }
    count = kept;
  }
};

/// Whether axes from w on come within the square root of `most` of the line through 0 along u,
/// between the planes across it at `low` and `high`. `begin`: where axes begin along it.
HWY_INLINE hn::Mask<D> come_near(const Vector& w, const Vector& ab, const Vector& u, V most, V low,
                                 V high, V& begin) {
  const V z0 = fast_dot(w, u), dz = fast_dot(ab, u);
  const Vector p = fast_add_scaled(w, u, hn::Neg(z0)), q = fast_add_scaled(ab, u, hn::Neg(dz));
  const V s =
      clamp01(D(), hn::Div(hn::Neg(fast_dot(p, q)), hn::Max(fast_dot(q, q), hn::Set(D(), 1e-30f))));
  const Vector v = fast_add_scaled(p, q, s);
  const V z1 = hn::Add(z0, dz);
  begin = hn::Min(z0, z1);
  const auto is_there = hn::And(hn::Ge(hn::Max(z0, z1), low), hn::Le(begin, high));
  return hn::And(is_there, hn::Le(fast_dot(v, v), most));
}

/// Chooses the capsules of a chunk whose axes come within `reach` of the packet's line, between the
/// planes across it at `near` and `far`.
HWY_INLINE void near_line(const CapsuleView& capsules, size_t begin, size_t end, float radius,
                          const float (&corner)[3], const RayPacket& rays, Chosen& chosen) {
  const D d;
  const float reach = radius + rays.spread;
  const V low = hn::Set(d, rays.near - radius), high = hn::Set(d, rays.far + radius);
  const Vector centre =
      set(rays.centre[0] - corner[0], rays.centre[1] - corner[1], rays.centre[2] - corner[2]);
  const Vector u = set(rays.along[0], rays.along[1], rays.along[2]);
  const V most = hn::Set(d, reach * reach);
  for (size_t i = begin; i < end; i += hn::Lanes(d)) {
    const Vector w = subtract(load(capsules.a, i), centre);
    V axis_begin;
    const auto is_near = come_near(w, load(capsules.ab, i), u, most, low, high, axis_begin);
    chosen.add(i, hn::And(is_near, hn::FirstN(d, end - i)));
  }
}

/// The hits so far of a group of rays.
struct LaneHits {
  HWY_INLINE LaneHits(const PacketHits& hits, size_t lane)
      : first(hn::Load(D(), hits.first + lane)),
        second(hn::Load(D(), hits.second + lane)),
        id(hn::Load(DU(), hits.id + lane)) {}

  HWY_INLINE void add(V t, hn::Mask<D> met, uint32_t own) {
    const D d;
    const DU du;
    t = hn::IfThenElse(met, t, hn::Set(d, std::numeric_limits<float>::infinity()));
    const auto is_first = hn::Lt(t, first);
    const auto own_id = hn::Set(du, own);
    const auto is_same = hn::RebindMask(d, hn::Eq(own_id, id));
    second = hn::IfThenElse(is_same, second, hn::Min(second, hn::Max(t, first)));
    id = hn::IfThenElse(hn::RebindMask(du, is_first), own_id, id);
    first = hn::Min(first, t);
  }

  HWY_INLINE void store(PacketHits& hits, size_t lane) const {
    hn::Store(first, D(), hits.first + lane);
    hn::Store(second, D(), hits.second + lane);
    hn::Store(id, DU(), hits.id + lane);
  }

 private:
  using DU = hn::RebindToUnsigned<D>;
  V first, second;
  hn::Vec<DU> id;
};

/// Lower limits of |q|^2 / |ab|^2 and of |ab|^2.
constexpr float min_across = 1.0f / 1600, min_squared = 1e-10f;

template <bool kStarts>
HWY_INLINE void meet(const CapsuleView& capsules, const Chosen& chosen, float radius,
                     const float (&corner)[3], const RayPacket& rays, PacketHits& hits) {
  if (chosen.count == 0) return;
  const D d;
  const V r2 = hn::Set(d, radius * radius), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V none = hn::Set(d, std::numeric_limits<float>::infinity());
  for (size_t lane = 0; lane < rays.count; lane += hn::Lanes(d)) {
    const Vector o = {hn::Sub(hn::Load(d, rays.origin[0] + lane), hn::Set(d, corner[0])),
                      hn::Sub(hn::Load(d, rays.origin[1] + lane), hn::Set(d, corner[1])),
                      hn::Sub(hn::Load(d, rays.origin[2] + lane), hn::Set(d, corner[2]))};
    const Vector u = {hn::Load(d, rays.direction[0] + lane), hn::Load(d, rays.direction[1] + lane),
                      hn::Load(d, rays.direction[2] + lane)};
    const V from = hn::Load(d, rays.from + lane), to = hn::Load(d, rays.to + lane);
    LaneHits found(hits, lane);
    for (size_t n = 0; n < chosen.count; ++n) {
      const size_t i = chosen.numbers[n];
      const Vector a = set(capsules.a[0][i], capsules.a[1][i], capsules.a[2][i]);
      const Vector ab = set(capsules.ab[0][i], capsules.ab[1][i], capsules.ab[2][i]);
      const Vector w = subtract(a, o);
      const V z0 = fast_dot(w, u), dz = fast_dot(ab, u);
      const Vector p = fast_add_scaled(w, u, hn::Neg(z0)), q = fast_add_scaled(ab, u, hn::Neg(dz));
      const V qq = fast_dot(q, q), ll = hn::Max(fast_dot(ab, ab), hn::Set(d, min_squared));
      const V inverse = hn::Div(one, hn::Max(qq, hn::Set(d, 1e-12f)));
      const V s0 = hn::Mul(hn::Neg(fast_dot(p, q)), inverse);
      const Vector across = fast_add_scaled(p, q, s0);
      const V room = hn::Sub(r2, fast_dot(across, across));
      const auto is_small = hn::Lt(qq, hn::Mul(ll, hn::Set(d, min_across)));
      auto met = hn::Or(hn::Ge(room, zero), is_small);
      const V shift = hn::Mul(dz, hn::Sqrt(hn::Mul(hn::Max(room, zero), hn::Div(inverse, ll))));
      const V s = clamp01(D(), hn::Sub(s0, shift));
      const Vector v = fast_add_scaled(p, q, s);
      const V under = hn::Sub(r2, fast_dot(v, v));
      met = hn::And(met, hn::Or(hn::Ge(under, zero), is_small));
      V t = hn::Sub(hn::MulAdd(s, dz, z0), hn::Sqrt(hn::Max(under, zero)));
      V exit = none;
      if constexpr (kStarts) {
        const V s_out = clamp01(D(), hn::Add(s0, shift));
        const Vector v_out = fast_add_scaled(p, q, s_out);
        exit = hn::Add(hn::MulAdd(s_out, dz, z0),
                       hn::Sqrt(hn::Max(hn::Sub(r2, fast_dot(v_out, v_out)), zero)));
      }
      if (!hn::AllFalse(d, is_small)) {
        const Vector middle = fast_add_scaled(p, q, hn::Set(d, 0.5f));
        const V nearest = hn::Max(zero, hn::Sub(hn::Sqrt(fast_dot(middle, middle)),
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
      found.add(t, met, capsules.ids[i]);
    }
    found.store(hits, lane);
  }
}

// No point of the ray before an axis begins, less the radius, is within the radius of it.
size_t on_ray(const CapsuleView& capsules, float radius, const CapsuleRay& ray, uint32_t* found,
              float* from) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const float wide = radius + capsule_ray_slack;
  const Vector o = set(ray.origin[0], ray.origin[1], ray.origin[2]);
  const Vector u = set(ray.direction[0], ray.direction[1], ray.direction[2]);
  const V most = hn::Set(d, wide * wide);
  const V low = hn::Set(d, -wide), high = hn::Set(d, ray.to + wide);
  size_t count = 0;
  for (size_t i = 0; i < capsules.count; i += hn::Lanes(d)) {
    const Vector w = subtract(load(capsules.a, i), o);
    V begin;
    const auto is_near = hn::And(come_near(w, load(capsules.ab, i), u, most, low, high, begin),
                                 hn::FirstN(d, capsules.count - i));
    const auto order = Compression<D>(is_near);
    hn::StoreU(order(hn::LoadU(du, capsules.ids + i)), du, found + count);
    hn::StoreU(order(hn::Add(begin, low)), d, from + count);
    count += hn::CountTrue(d, is_near);
  }
  return count;
}

/// Capsules of a chunk, projected to the plane normal to the common direction of the rays.
struct SeenCapsules {
  static constexpr size_t most = Chosen::most;
  /// The position of an end and the vector to the other end, along two axes of the plane and along
  /// the rays; the inverse of |q|^2; and (s0 - s) / sqrt(H).
  alignas(64) float px[most], py[most], pz[most], qx[most], qy[most], qz[most], inverse[most],
      shift[most];
};

template <bool kStarts>
HWY_INLINE void meet_seen(const SeenCapsules& seen, const uint32_t* ids, const Chosen& chosen,
                          float radius, const RayPacket& rays, const Vector (&axes)[3],
                          PacketHits& hits) {
  const D d;
  const V r2 = hn::Set(d, radius * radius), zero = hn::Zero(d);
  for (size_t lane = 0; lane < rays.count; lane += hn::Lanes(d)) {
    const Vector o = {hn::Sub(hn::Load(d, rays.origin[0] + lane), hn::Set(d, rays.centre[0])),
                      hn::Sub(hn::Load(d, rays.origin[1] + lane), hn::Set(d, rays.centre[1])),
                      hn::Sub(hn::Load(d, rays.origin[2] + lane), hn::Set(d, rays.centre[2]))};
    const V x = fast_dot(o, axes[0]), y = fast_dot(o, axes[1]), z = fast_dot(o, axes[2]);
    const V from = hn::Load(d, rays.from + lane), to = hn::Load(d, rays.to + lane);
    LaneHits found(hits, lane);
    for (size_t n = 0; n < chosen.count; ++n) {
      const size_t i = chosen.numbers[n];
      const V qx = hn::Set(d, seen.qx[i]), qy = hn::Set(d, seen.qy[i]);
      const V px = hn::Sub(hn::Set(d, seen.px[i]), x), py = hn::Sub(hn::Set(d, seen.py[i]), y);
      const V s0 =
          hn::Mul(hn::NegMulAdd(px, qx, hn::Neg(hn::Mul(py, qy))), hn::Set(d, seen.inverse[i]));
      const V ax = hn::MulAdd(qx, s0, px), ay = hn::MulAdd(qy, s0, py);
      const V room = hn::NegMulAdd(ax, ax, hn::NegMulAdd(ay, ay, r2));
      const V shift = hn::Mul(hn::Set(d, seen.shift[i]), hn::Sqrt(hn::Max(room, zero)));
      const V pz = hn::Sub(hn::Set(d, seen.pz[i]), z), qz = hn::Set(d, seen.qz[i]);
      const V s = clamp01(D(), hn::Sub(s0, shift));
      const V vx = hn::MulAdd(qx, s, px), vy = hn::MulAdd(qy, s, py);
      const V under = hn::NegMulAdd(vx, vx, hn::NegMulAdd(vy, vy, r2));
      V t = hn::Sub(hn::MulAdd(s, qz, pz), hn::Sqrt(hn::Max(under, zero)));
      auto met = hn::And(hn::Ge(under, zero), hn::Ge(room, zero));
      if constexpr (kStarts) {
        const V s_out = clamp01(D(), hn::Add(s0, shift));
        const V ox = hn::MulAdd(qx, s_out, px), oy = hn::MulAdd(qy, s_out, py);
        const V left = hn::NegMulAdd(ox, ox, hn::NegMulAdd(oy, oy, r2));
        const V exit = hn::Add(hn::MulAdd(s_out, qz, pz), hn::Sqrt(hn::Max(left, zero)));
        met = hn::And(met, hn::Ge(exit, from));
      }
      t = hn::Max(t, from);
      met = hn::And(met, hn::Le(t, to));
      found.add(t, met, ids[i]);
    }
    found.store(hits, lane);
  }
}

/// Rays of one direction: quantities of a capsule that do not depend on the ray are computed once.
HWY_INLINE void meet_parallel(const CapsuleView& capsules, float wide, const float (&corner)[3],
                              const RayPacket& rays, SeenIds* ids, PacketHits& hits) {
  const D d;
  SeenCapsules seen;
  const Vec3 along_rays{rays.along[0], rays.along[1], rays.along[2]};
  Vec3 e, f;
  complete_basis(along_rays, e, f);
  const Vector axes[3] = {set_lanes(d, e), set_lanes(d, f), set_lanes(d, along_rays)};
  const Vector centre =
      set(rays.centre[0] - corner[0], rays.centre[1] - corner[1], rays.centre[2] - corner[2]);
  const float reach = wide + rays.spread;
  const V most = hn::Set(d, reach * reach), tiny = hn::Set(d, 1e-30f), one = hn::Set(d, 1.0f);
  const V low = hn::Set(d, rays.near - wide), high = hn::Set(d, rays.far + wide);
  for (size_t begin = 0; begin < capsules.count; begin += SeenCapsules::most) {
    const size_t end = std::min(capsules.count, begin + SeenCapsules::most);
    Chosen chosen, along;
    uint64_t small = 0;  // by number
    for (size_t at = 0; at < end - begin; at += hn::Lanes(d)) {
      const size_t i = begin + at;
      const Vector w = subtract(load(capsules.a, i), centre), ab = load(capsules.ab, i);
      const V px = fast_dot(w, axes[0]), py = fast_dot(w, axes[1]), pz = fast_dot(w, axes[2]);
      const V qx = fast_dot(ab, axes[0]), qy = fast_dot(ab, axes[1]), qz = fast_dot(ab, axes[2]);
      const V qq = hn::MulAdd(qx, qx, hn::Mul(qy, qy));
      const V inverse = hn::Div(one, hn::Max(qq, tiny));
      const V s = clamp01(D(), hn::Mul(hn::NegMulAdd(px, qx, hn::Neg(hn::Mul(py, qy))), inverse));
      const V vx = hn::MulAdd(qx, s, px), vy = hn::MulAdd(qy, s, py), z1 = hn::Add(pz, qz);
      auto is_near = hn::And(hn::Ge(hn::Max(pz, z1), low), hn::Le(hn::Min(pz, z1), high));
      is_near = hn::And(is_near, hn::Le(hn::MulAdd(vx, vx, hn::Mul(vy, vy)), most));
      is_near = hn::And(is_near, hn::FirstN(d, end - i));
      chosen.add(at, is_near);
      const V ll = hn::Max(hn::MulAdd(qz, qz, qq), hn::Set(d, min_squared));
      const auto is_small = hn::Lt(qq, hn::Mul(ll, hn::Set(d, min_across)));
      small |= bits_of(d, hn::And(is_near, is_small)) << at;
      hn::Store(px, d, seen.px + at);
      hn::Store(py, d, seen.py + at);
      hn::Store(pz, d, seen.pz + at);
      hn::Store(qx, d, seen.qx + at);
      hn::Store(qy, d, seen.qy + at);
      hn::Store(qz, d, seen.qz + at);
      hn::Store(inverse, d, seen.inverse + at);
      hn::Store(hn::Mul(qz, hn::Sqrt(hn::Div(inverse, ll))), d, seen.shift + at);
    }
    chosen.drop_seen(capsules.ids + begin, ids);
    if (HWY_UNLIKELY(small)) chosen.move(small, begin, along);
    if (rays.starts) {
      meet_seen<true>(seen, capsules.ids + begin, chosen, wide, rays, axes, hits);
      meet<true>(capsules, along, wide, corner, rays, hits);
    } else {
      meet_seen<false>(seen, capsules.ids + begin, chosen, wide, rays, axes, hits);
      meet<false>(capsules, along, wide, corner, rays, hits);
    }
  }
}

void meet_list(const CapsuleView& capsules, float radius, const float (&corner)[3],
               const RayPacket& rays, SeenIds* seen, PacketHits& hits) {
  const float wide = radius + capsule_ray_slack;
  if (rays.is_parallel) return meet_parallel(capsules, wide, corner, rays, seen, hits);
  for (size_t begin = 0; begin < capsules.count; begin += Chosen::most) {
    const size_t end = std::min(capsules.count, begin + Chosen::most);
    Chosen chosen;
    near_line(capsules, begin, end, wide, corner, rays, chosen);
    chosen.drop_seen(capsules.ids, seen);
    if (rays.starts)
      meet<true>(capsules, chosen, wide, corner, rays, hits);
    else
      meet<false>(capsules, chosen, wide, corner, rays, hits);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(meet_list);
HWY_EXPORT(on_ray);

void PacketHits::clear() {
  std::fill_n(first, RayPacket::most, std::numeric_limits<float>::infinity());
  std::fill_n(second, RayPacket::most, std::numeric_limits<float>::infinity());
  std::fill_n(id, RayPacket::most, UINT32_MAX);
}

void meet_capsules(const CapsuleView& capsules, float radius, const float (&corner)[3],
                   const RayPacket& rays, SeenIds* seen, PacketHits& hits) {
  HWY_DYNAMIC_DISPATCH(meet_list)(capsules, radius, corner, rays, seen, hits);
}

size_t capsules_on_ray(const CapsuleView& capsules, float radius, const CapsuleRay& ray,
                       uint32_t* ids, float* from) {
  return HWY_DYNAMIC_DISPATCH(on_ray)(capsules, radius, ray, ids, from);
}

}  // namespace msq
#endif
