// SPDX-License-Identifier: Apache-2.0
// The operations of StrutEntries::find(), in its order and without fused ones, so that the bits are
// the same. See there for the reasons.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/packet_entries.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "structure/foam/rays/packet_entries.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using Vector = Lanes3<D>;

HWY_INLINE Vector add(const Vector& a, const Vector& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector points_at(const Vector& origin, const Vector& direction, V t) {
  return add(origin, scale(direction, t));
}

void find(const StrutLine& strut, Vec3 cell, double radius, const PacketRays& rays, uint32_t which,
          PacketEntries& found) {
  const D d;
  const Vector along = set_lanes(d, strut.along), home = set_lanes(d, strut.home),
               seed = set_lanes(d, strut.line.seed), offset = set_lanes(d, strut.line.offset),
               half_cell = set_lanes(d, cell * 0.5), corner = set_lanes(d, strut.corner),
               a = set_lanes(d, strut.a);
  const V r = hn::Set(d, radius), r_squared = hn::Set(d, radius * radius),
          r8 = hn::Set(d, 8 * radius), inverse_radius = hn::Set(d, 1 / radius);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V low_end = hn::Set(d, std::min(0.0, strut.length)),
          high_end = hn::Set(d, std::max(0.0, strut.length));
  const uint32_t all = (uint32_t{1} << hn::Lanes(d)) - 1;
  for (size_t lane = 0; lane < PacketRays::most; lane += hn::Lanes(d)) {
    const uint32_t here = which >> lane & all;
    if (!here) continue;
    const Vector origin = load_lanes(d, rays.origin, lane), u = load_lanes(d, rays.direction, lane);
    const V error = hn::Add(hn::Load(d, rays.error + lane), hn::Set(d, strut.error));
    const V tolerance = hn::Load(d, rays.tolerance + lane);
    const Vector o = subtract(origin, home);
    const V t0 = dot(subtract(half_cell, o), u);
    const Vector w = subtract(subtract(points_at(o, u, t0), seed), offset);
    const Vector p = subtract(w, scale(along, dot(w, along)));
    const Vector q = subtract(u, scale(along, dot(u, along)));
    const V qq = dot(q, q), pq = dot(p, q);
    const V under = hn::Sub(hn::Mul(pq, pq), hn::Mul(qq, hn::Sub(dot(p, p), r_squared)));
    const V end_room = hn::Add(hn::Set(d, end_error), error);
    const V room = hn::Mul(hn::Mul(error, hn::Add(r8, error)), qq);
    const V inverse = hn::Div(one, qq), middle = hn::Sub(t0, hn::Mul(pq, inverse));
    const V root = hn::Sqrt(hn::Max(under, zero)), half = hn::Mul(root, inverse);
    const V in = hn::Sub(middle, half), out = hn::Add(middle, half);
    const auto is_across = hn::Ge(qq, hn::Set(d, parallel_squared));
    const auto is_beside = hn::Lt(under, hn::Neg(room));
    const auto is_deep =
        hn::And(hn::Gt(under, zero),
                hn::Le(hn::Mul(error, r), hn::Mul(hn::Mul(hn::Set(d, 0.25), tolerance), root)));
    const V from = hn::Load(d, rays.from + lane), to = hn::Load(d, rays.to + lane);
    const auto is_elsewhere = hn::Or(hn::Lt(out, from), hn::Gt(in, to));
    const V s = dot(subtract(subtract(points_at(origin, u, in), corner), a), along);
    const V by = hn::Max(hn::Sub(low_end, s), hn::Sub(s, high_end));
    const auto enters = hn::Gt(in, from);
    const auto is_past = hn::And(enters, hn::Gt(by, end_room));
    const auto is_between = hn::And(enters, hn::Le(by, hn::Neg(end_room)));
    const auto missed =
        hn::And(is_across, hn::Or(is_beside, hn::And(is_deep, hn::Or(is_elsewhere, is_past))));
    const auto met = hn::And(hn::And(is_across, is_deep),
                             hn::AndNot(hn::Or(is_beside, is_elsewhere), is_between));
    found.missed |= (static_cast<uint32_t>(bits_of(d, missed)) & here) << lane;
    found.met |= (static_cast<uint32_t>(bits_of(d, met)) & here) << lane;
    hn::Store(in, d, found.t + lane);
    const Vector normal = scale(add(p, scale(q, hn::Sub(in, t0))), inverse_radius);
    store_lanes(d, normal, found.normal, lane);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find);

void find_packet_entries(const StrutLine& strut, Vec3 scale, double radius, const PacketRays& rays,
                         uint32_t which, PacketEntries& found) {
  HWY_DYNAMIC_DISPATCH(find)(strut, scale, radius, rays, which, found);
}

}  // namespace msq
#endif
