// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray/ray_starts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "base/ray_lanes-inl.h"
#include "ray/ray_starts.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Vector = Lanes3<D>;

HWY_INLINE M is_within(V x, double low, double high) {
  return hn::And(hn::Ge(x, hn::Set(D(), low)), hn::Le(x, hn::Set(D(), high)));
}
HWY_INLINE M contains(const Box3& box, const Vector& p) {
  return hn::And(
      is_within(p.x, box.min.x, box.max.x),
      hn::And(is_within(p.y, box.min.y, box.max.y), is_within(p.z, box.min.z, box.max.z)));
}

/// Clips [from, to] along one axis, as clip_to_box() does. Returns the lanes whose rays may meet
/// the box.
HWY_INLINE M clip_axis(V o, V d, double min, double max, V& from, V& to) {
  const D tag;
  const M is_across = hn::Eq(d, hn::Zero(tag)), may_meet = is_within(o, min, max);
  if (hn::AllTrue(tag, is_across)) return may_meet;
  const V one = hn::Div(hn::Sub(hn::Set(tag, min), o), d);
  const V other = hn::Div(hn::Sub(hn::Set(tag, max), o), d);
  const V near = hn::Min(one, other), far = hn::Max(one, other), zero = hn::Zero(tag);
  const V less = hn::Set(tag, 1 - 0x1p-50), more = hn::Set(tag, 1 + 0x1p-50);
  const V low = hn::Mul(near, hn::IfThenElse(hn::Gt(near, zero), less, more));
  const V high = hn::Mul(far, hn::IfThenElse(hn::Gt(far, zero), more, less));
  from = hn::IfThenElse(is_across, from, hn::Max(low, from));
  to = hn::IfThenElse(is_across, to, hn::Min(high, to));
  return hn::Or(hn::Not(is_across), may_meet);
}
HWY_INLINE M clip(const Vector& o, const Vector& d, const Box3& box, V& from, V& to) {
  const D tag;
  const M meets = hn::And(clip_axis(o.x, d.x, box.min.x, box.max.x, from, to),
                          hn::And(clip_axis(o.y, d.y, box.min.y, box.max.y, from, to),
                                  clip_axis(o.z, d.z, box.min.z, box.max.z, from, to)));
  const V infinite = hn::Set(tag, std::numeric_limits<double>::infinity());
  return hn::And(meets, hn::And(hn::Le(from, to), hn::Lt(from, infinite)));
}

void start(const RaySearch* searches, size_t count, const StartBoxes& boxes, RayStarts& starts) {
  const D d;
  const V zero = hn::Zero(d), tolerance = hn::Set(d, boxes.tolerance);
  starts.miss = starts.begin = starts.crosses = 0;
  for (size_t lane = 0; lane < count; lane += hn::Lanes(d)) {
    const SearchLanes<D> lanes(searches, lane, count);
    const Vector o = lanes.origin, u = lanes.direction;
    V low = lanes.from, high = hn::Add(lanes.to, hn::Set(d, boxes.beyond));
    M meets = hn::Le(low, lanes.to);
    meets = hn::And(meets, clip(o, u, boxes.bounds, low, high));
    const Vector place = add_scaled(o, u, low);
    const M begins = hn::And(meets, contains(boxes.near, place));
    const V end = hn::Sub(high, low);
    hn::Store(low, d, starts.offset + lane);
    store_lanes(d, place, starts.origin, lane);
    hn::Store(end, d, starts.end + lane);
    starts.miss |= static_cast<uint32_t>(bits_of(d, hn::Not(meets))) << lane;
    starts.begin |= static_cast<uint32_t>(bits_of(d, begins)) << lane;
    if (!boxes.has_box) continue;
    // As settle_entry(), for entries that it settles by two evaluations of membership.
    V low_in = zero, high_in = end;
    const M crosses = clip(place, u, boxes.box, low_in, high_in);
    const auto is_in = [&](V t) HWY_ATTR { return contains(boxes.box, add_scaled(place, u, t)); };
    const V after = hn::Min(hn::Add(low_in, tolerance), end);
    const V before = hn::Max(hn::Sub(low_in, tolerance), zero);
    const M is_there = is_in(low_in);
    const M is_near = hn::Le(hn::Sub(low_in, before), tolerance);
    const M is_first = hn::Or(hn::Le(low_in, zero), hn::AndNot(is_in(before), is_near));
    const M is_settled = hn::Or(hn::And(is_there, is_first), hn::AndNot(is_there, is_in(after)));
    const V enter = hn::IfThenElse(is_there, low_in, after);
    hn::Store(enter, d, starts.enter + lane);
    hn::Store(hn::Max(enter, high_in), d, starts.leave + lane);
    starts.crosses |=
        static_cast<uint32_t>(bits_of(d, hn::And(begins, hn::And(crosses, is_settled)))) << lane;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(start);

void start_rays(const RaySearch* searches, size_t count, const StartBoxes& boxes,
                RayStarts& starts) {
  HWY_DYNAMIC_DISPATCH(start)(searches, count, boxes, starts);
}

}  // namespace msq
#endif
