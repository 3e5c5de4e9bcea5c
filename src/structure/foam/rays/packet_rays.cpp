// SPDX-License-Identifier: Apache-2.0
// The operations of FoamFrame::ray(), in its order and without fused ones, so that the bits are the
// same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/packet_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "base/ray_lanes-inl.h"
#include "structure/foam/rays/packet_rays.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using Vector = Lanes3<D>;

HWY_INLINE V largest(const Vector& v) {
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

void set(const FoamFrame& frame, const RaySearch* first, size_t count, PacketRays& rays) {
  const D d;
  const V to_foam = hn::Set(d, frame.to_foam), rounding = hn::Set(d, coordinate_rounding(1));
  const auto& m = frame.grid->rotation.m;
  const Vector columns[3] = {set_lanes(d, Vec3{m[0], m[3], m[6]}),
                             set_lanes(d, Vec3{m[1], m[4], m[7]}),
                             set_lanes(d, Vec3{m[2], m[5], m[8]})};
  const auto to_grid = [&](const Vector& v) HWY_ATTR {
    return Vector{dot(columns[0], v), dot(columns[1], v), dot(columns[2], v)};
  };
  for (size_t lane = 0; lane < count; lane += hn::Lanes(d)) {
    const SearchLanes<D> lanes(first, lane, count);
    const Vector o = lanes.origin, u = lanes.direction;
    const V own_to = lanes.to;
    const Vector origin = scale(to_grid(subtract(o, set_lanes(d, frame.grid->origin))), to_foam);
    const Vector direction = to_grid(u);
    const V to = hn::Mul(own_to, to_foam);
    const V in_grid = hn::Max(largest(origin), largest(add_scaled(origin, direction, to)));
    const V in_model = hn::Max(largest(o), largest(add_scaled(o, u, own_to)));
    const V max = hn::Max(in_grid, hn::Mul(to_foam, in_model));
    store_lanes(d, origin, rays.origin, lane);
    store_lanes(d, direction, rays.direction, lane);
    hn::Store(hn::Mul(lanes.from, to_foam), d, rays.from + lane);
    hn::Store(to, d, rays.to + lane);
    hn::Store(hn::Mul(rounding, hn::Add(hn::Set(d, 8), max)), d, rays.error + lane);
    hn::Store(hn::Max(hn::Set(d, frame.tolerance), hn::Mul(rounding, max)), d,
              rays.tolerance + lane);
  }
  for (size_t lane = count; lane < PacketRays::most; ++lane) {
    rays.from[lane] = 1;
    rays.to[lane] = -1;
  }
}

uint32_t beside(const PacketRays& rays, size_t first, double max_apart, double max_turned) {
  const D d;
  const Vec3 along{rays.direction[0][first], rays.direction[1][first], rays.direction[2][first]};
  const Vector u = set_lanes(d, along), from = set_lanes(d, rays.at(first, rays.from[first]));
  uint32_t found = 0;
  for (size_t lane = 0; lane < PacketRays::most; lane += hn::Lanes(d)) {
    const Vector direction = load_lanes(d, rays.direction, lane), turned = subtract(direction, u);
    const Vector begin =
        add_scaled(load_lanes(d, rays.origin, lane), direction, hn::Load(d, rays.from + lane));
    const Vector apart = subtract(begin, from);
    const Vector across = subtract(apart, scale(u, dot(apart, u)));
    const auto is_beside = hn::And(hn::Le(dot(turned, turned), hn::Set(d, max_turned * max_turned)),
                                   hn::Le(dot(across, across), hn::Set(d, max_apart * max_apart)));
    found |= static_cast<uint32_t>(bits_of(d, is_beside)) << lane;
  }
  return found;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(set);
HWY_EXPORT(beside);

void PacketRays::set(const FoamFrame& frame, const RaySearch* first, size_t count) {
  searches = first;
  HWY_DYNAMIC_DISPATCH(set)(frame, first, count, *this);
}

uint32_t PacketRays::beside(size_t first, double max_apart, double max_turned) const {
  return HWY_DYNAMIC_DISPATCH(beside)(*this, first, max_apart, max_turned);
}

}  // namespace msq
#endif
