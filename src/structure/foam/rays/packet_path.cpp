// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/packet_path.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/mask_bits-inl.h"
#include "structure/foam/rays/packet_path.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<float, RayPacket::most>;
using V = hn::Vec<D>;
using DD = hn::CappedTag<double, 8>;
using VD = hn::Vec<DD>;
using DN = hn::Rebind<float, DD>;

HWY_INLINE void store_narrow(VD v, float* to) {
  hn::Store(hn::DemoteTo(DN(), v), DN(), to);
}

bool choose(const PacketRays& rays, uint32_t live, Vec3 scale, PacketCourse& course,
            RayPacket& packet) {
  const DD d;
  const VD zero = hn::Zero(d);
  VD sums[3] = {zero, zero, zero}, error = zero;
  auto differs = hn::FirstN(DN(), 0);
  const auto first = static_cast<size_t>(std::countr_zero(live));
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    const auto is_live = lanes_of(d, live >> lane);
    error = hn::Max(error, hn::IfThenElseZero(is_live, hn::Load(d, rays.error + lane)));
    for (int axis = 0; axis < 3; ++axis) {
      const VD along = hn::Load(d, rays.direction[axis] + lane);
      sums[axis] = hn::Add(sums[axis], hn::IfThenElseZero(is_live, along));
      const auto narrow = hn::DemoteTo(DN(), along);
      hn::Store(narrow, DN(), packet.direction[axis] + lane);
      const auto of_first = hn::Set(DN(), static_cast<float>(rays.direction[axis][first]));
      differs = hn::Or(differs, hn::And(lanes_of(DN(), live >> lane), hn::Ne(narrow, of_first)));
    }
  }
  packet.is_parallel = hn::AllFalse(DN(), differs);
  for (int axis = 0; axis < 3; ++axis) packet.along[axis] = packet.direction[axis][first];
  course.error = hn::GetLane(hn::MaxOfLanes(d, error));
  double sum[3];
  for (int axis = 0; axis < 3; ++axis) sum[axis] = hn::GetLane(hn::SumOfLanes(d, sums[axis]));
  int k = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(sum[axis]) * scale[k] > std::abs(sum[k]) * scale[axis]) k = axis;
  course.axis = k;
  course.up = sum[k] > 0;
  // Signs are turned such that the packet goes up.
  const VD sign = hn::Set(d, course.up ? 1.0 : -1.0), far = hn::Set(d, 1e300);
  const VD least = hn::Set(d, 0.5 * std::abs(sum[k]) / std::popcount(live));
  auto is_too_flat = hn::FirstN(d, 0);
  VD begin = far;
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    const auto is_live = lanes_of(d, live >> lane);
    const VD along = hn::Load(d, rays.direction[k] + lane);
    is_too_flat = hn::Or(is_too_flat, hn::AndNot(hn::Ge(hn::Mul(sign, along), least), is_live));
    const VD inverse = hn::Div(hn::Set(d, 1), along);
    hn::Store(hn::IfThenElseZero(is_live, inverse), d, course.inverse + lane);
    const VD place =
        hn::Add(hn::Load(d, rays.origin[k] + lane), hn::Mul(along, hn::Load(d, rays.from + lane)));
    begin = hn::Min(begin, hn::IfThenElse(is_live, hn::Mul(sign, place), far));
  }
  const double low = hn::GetLane(hn::MinOfLanes(d, begin));
  course.begin = course.up ? low : -low;
  return hn::AllFalse(d, is_too_flat);
}

void place(const PacketRays& rays, const PacketCourse& course, const PathBase& base, Vec3 scale,
           uint32_t live, PacketPath& path, RayPacket& packet) {
  const DD d;
  const int k = course.axis, lateral[2] = {(k + 1) % 3, (k + 2) % 3};
  const VD plane = hn::Set(d, base.plane), size = hn::Set(d, scale[k]);
  const VD rounding = hn::Set(d, double(along_rounding)), zero = hn::Zero(d);
  const VD margin = hn::Set(d, -double(ray_list_margin));
  const VD own_begin = hn::Set(d, course.up ? 0 : scale[k]);
  packet.starts = false;
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    const auto is_live = lanes_of(d, live >> lane);
    const VD inverse = hn::Load(d, course.inverse + lane);
    const VD t = hn::Mul(hn::Sub(plane, hn::Load(d, rays.origin[k] + lane)), inverse);
    const VD way = hn::IfThenElse(is_live, hn::Mul(size, hn::Abs(inverse)), hn::Set(d, 1));
    const VD from = hn::Sub(hn::Load(d, rays.from + lane), t);
    const VD to = hn::Sub(hn::Load(d, rays.to + lane), t);
    hn::Store(t, d, path.enter + lane);
    hn::Store(way, d, path.way + lane);
    store_narrow(way, path.step + lane);
    store_narrow(from, path.from + lane);
    store_narrow(to, path.to + lane);
    store_narrow(own_begin, packet.origin[k] + lane);
    for (int side = 0; side < 2; ++side) {
      const int axis = lateral[side];
      const VD along = hn::Load(d, rays.direction[axis] + lane);
      const VD at = hn::Sub(hn::Add(hn::Load(d, rays.origin[axis] + lane), hn::Mul(along, t)),
                            hn::Set(d, base.corner[side]));
      store_narrow(at, path.place[side] + lane);
      store_narrow(at, packet.origin[axis] + lane);
      store_narrow(hn::Mul(along, way), path.slope[side] + lane);
    }
    const VD low = hn::Max(hn::Sub(from, rounding), zero), high = hn::Add(to, rounding);
    store_narrow(hn::IfThenElse(is_live, low, hn::Set(d, 1)), packet.from + lane);
    store_narrow(hn::IfThenElse(is_live, high, hn::Set(d, -1)), packet.to + lane);
    packet.starts |= !hn::AllFalse(d, hn::And(is_live, hn::Ge(from, margin)));
  }
}

uint32_t may_meet(const PacketRays& rays, int slab, const PacketHits& hits, uint32_t active,
                  double seen, PacketPath& path) {
  const DD d;
  const VD margin = hn::Set(d, 0.5 * double(ray_list_margin));
  uint32_t found = 0;
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    const VD base = hn::Load(d, path.enter + lane), way = hn::Load(d, path.way + lane);
    const VD enter = hn::Add(base, hn::Mul(hn::Set(d, slab), way));
    const VD all = hn::Min(hn::Load(d, rays.to + lane), hn::Add(hn::Add(enter, way), margin));
    const VD limit = hn::Min(all, hn::Add(enter, hn::Mul(hn::Set(d, seen), way)));
    hn::Store(limit, d, path.last + lane);
    const VD first = hn::Add(base, hn::PromoteTo(d, hn::Load(DN(), hits.first + lane)));
    found |= static_cast<uint32_t>(bits_of(d, hn::Le(first, limit))) << lane;
  }
  return found & active;
}

SlabCrossing cross(const PacketPath& path, const PathSlab& slab, uint32_t live, RayPacket& packet) {
  const D d;
  const V begin = hn::Set(d, static_cast<float>(slab.number)), one = hn::Set(d, 1.0f);
  const V zero = hn::Zero(d), far = hn::Set(d, 1e30f);
  V low[2] = {far, far}, high[2] = {hn::Neg(far), hn::Neg(far)};
  V in_sum[2] = {zero, zero}, out_sum[2] = {zero, zero}, total = zero;
  const int lateral[2] = {(slab.axis + 1) % 3, (slab.axis + 2) % 3};
  SlabCrossing crossing;
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    const V step = hn::Load(d, path.step + lane), enter = hn::Mul(begin, step);
    const V from = hn::Sub(hn::Load(d, path.from + lane), enter);
    const V to = hn::Sub(hn::Load(d, path.to + lane), enter);
    const auto is_live = lanes_of(d, live >> lane);
    const auto has_ended = hn::And(is_live, hn::Lt(to, zero));
    const auto active = hn::And(is_live, hn::And(hn::Ge(to, zero), hn::Le(from, step)));
    crossing.active |= static_cast<uint32_t>(bits_of(d, active)) << lane;
    crossing.ended |= static_cast<uint32_t>(bits_of(d, has_ended)) << lane;
    const V by_t = hn::Div(one, step);
    const V first_part = hn::Mul(hn::Max(from, zero), by_t),
            last_part = hn::Min(hn::Mul(to, by_t), one);
    total = hn::Add(total, hn::IfThenElseZero(active, one));
    for (int side = 0; side < 2; ++side) {
      const V slope = hn::Load(d, path.slope[side] + lane);
      const V in = hn::MulAdd(slope, begin, hn::Load(d, path.place[side] + lane));
      const V out = hn::Add(in, slope);
      in_sum[side] = hn::Add(in_sum[side], hn::IfThenElseZero(active, in));
      out_sum[side] = hn::Add(out_sum[side], hn::IfThenElseZero(active, out));
      const V p = hn::MulAdd(slope, first_part, in), q = hn::MulAdd(slope, last_part, in);
      low[side] = hn::Min(low[side], hn::IfThenElse(active, hn::Min(p, q), far));
      high[side] = hn::Max(high[side], hn::IfThenElse(active, hn::Max(p, q), hn::Neg(far)));
    }
  }
  if (!crossing.active) return crossing;
  const float inverse = 1 / hn::GetLane(hn::SumOfLanes(d, total));
  float in[2], out[2];
  for (int side = 0; side < 2; ++side) {
    crossing.low[side] = hn::GetLane(hn::MinOfLanes(d, low[side]));
    crossing.high[side] = hn::GetLane(hn::MaxOfLanes(d, high[side]));
    in[side] = hn::GetLane(hn::SumOfLanes(d, in_sum[side])) * inverse;
    out[side] = hn::GetLane(hn::SumOfLanes(d, out_sum[side])) * inverse;
  }
  V squared = zero;
  for (size_t lane = 0; lane < RayPacket::most; lane += hn::Lanes(d)) {
    V in_squared = zero, out_squared = zero;
    for (int side = 0; side < 2; ++side) {
      const V slope = hn::Load(d, path.slope[side] + lane);
      const V place = hn::MulAdd(slope, begin, hn::Load(d, path.place[side] + lane));
      const V by_in = hn::Sub(place, hn::Set(d, in[side]));
      const V by_out = hn::Sub(hn::Add(place, slope), hn::Set(d, out[side]));
      in_squared = hn::MulAdd(by_in, by_in, in_squared);
      out_squared = hn::MulAdd(by_out, by_out, out_squared);
    }
    squared = hn::Max(squared, hn::IfThenElseZero(lanes_of(d, crossing.active >> lane),
                                                  hn::Max(in_squared, out_squared)));
  }
  packet.centre[slab.axis] = slab.begin;
  for (int side = 0; side < 2; ++side) packet.centre[lateral[side]] = in[side];
  // Widened by the length of rays beyond the slab.
  packet.spread = std::sqrt(hn::GetLane(hn::MaxOfLanes(d, squared))) * 1.01f + 1e-5f;
  if (packet.is_parallel) return crossing;
  const float x = out[0] - in[0], y = out[1] - in[1];
  const float by_length = 1 / std::sqrt(slab.rise * slab.rise + x * x + y * y);
  packet.along[slab.axis] = slab.rise * by_length;
  packet.along[lateral[0]] = x * by_length;
  packet.along[lateral[1]] = y * by_length;
  return crossing;
}

size_t crossed(const PacketPath& path, int number, uint32_t active, const SlabCells& cells,
               CrossedCell* found) {
  constexpr float room = 1e-5f, least_slope = 1e-6f;
  constexpr size_t groups = RayPacket::most / hn::MaxLanes(D());
  const D d;
  const V begin = hn::Set(d, static_cast<float>(number)), zero = hn::Zero(d),
          one = hn::Set(d, 1.0f);
  // Parts of the way in the rows of cells along either axis.
  V enter[2][SlabCells::most][groups], leave[2][SlabCells::most][groups];
  for (int side = 0; side < 2; ++side)
    for (size_t group = 0; group < groups; ++group) {
      const size_t lane = group * hn::Lanes(d);
      const V slope = hn::Load(d, path.slope[side] + lane);
      const V in = hn::MulAdd(slope, begin, hn::Load(d, path.place[side] + lane));
      const V inverse =
          hn::Div(one, hn::CopySign(hn::Max(hn::Abs(slope), hn::Set(d, least_slope)), slope));
      for (int32_t i = cells.first[side]; i <= cells.last[side]; ++i) {
        const float low = static_cast<float>(i) * cells.size[side];
        const V p = hn::Mul(hn::Sub(hn::Set(d, low - room), in), inverse);
        const V q = hn::Mul(hn::Sub(hn::Set(d, low + cells.size[side] + room), in), inverse);
        enter[side][i - cells.first[side]][group] = hn::Max(hn::Min(p, q), zero);
        leave[side][i - cells.first[side]][group] = hn::Min(hn::Max(p, q), one);
      }
    }
  size_t count = 0;
  for (int32_t j = cells.first[1]; j <= cells.last[1]; ++j)
    for (int32_t i = cells.first[0]; i <= cells.last[0]; ++i) {
      V first = one, last = zero;
      uint32_t rays = 0;
      for (size_t group = 0; group < groups; ++group) {
        const size_t lane = group * hn::Lanes(d);
        const V from =
            hn::Max(enter[0][i - cells.first[0]][group], enter[1][j - cells.first[1]][group]);
        const V to =
            hn::Min(leave[0][i - cells.first[0]][group], leave[1][j - cells.first[1]][group]);
        const auto crosses = hn::And(hn::Le(from, to), lanes_of(d, active >> lane));
        rays |= static_cast<uint32_t>(bits_of(d, crosses)) << lane;
        first = hn::Min(first, hn::IfThenElse(crosses, from, one));
        last = hn::Max(last, hn::IfThenElseZero(crosses, to));
      }
      if (!rays) continue;
      found[count++] = {{i, j},
                        rays,
                        hn::GetLane(hn::MinOfLanes(d, first)),
                        hn::GetLane(hn::MaxOfLanes(d, last))};
    }
  return count;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(choose);
HWY_EXPORT(place);
HWY_EXPORT(may_meet);
HWY_EXPORT(cross);
HWY_EXPORT(crossed);

bool set_course(const PacketRays& rays, uint32_t live, Vec3 scale, PacketCourse& course,
                RayPacket& packet) {
  return HWY_DYNAMIC_DISPATCH(choose)(rays, live, scale, course, packet);
}

void set_path(const PacketRays& rays, const PacketCourse& course, const PathBase& base, Vec3 scale,
              uint32_t live, PacketPath& path, RayPacket& packet) {
  HWY_DYNAMIC_DISPATCH(place)(rays, course, base, scale, live, path, packet);
}

uint32_t who_may_meet(const PacketRays& rays, int slab, const PacketHits& hits, uint32_t active,
                      double seen, PacketPath& path) {
  return HWY_DYNAMIC_DISPATCH(may_meet)(rays, slab, hits, active, seen, path);
}

SlabCrossing cross_slab(const PacketPath& path, const PathSlab& slab, uint32_t live,
                        RayPacket& packet) {
  return HWY_DYNAMIC_DISPATCH(cross)(path, slab, live, packet);
}

size_t find_crossed_cells(const PacketPath& path, int number, uint32_t active,
                          const SlabCells& cells,
                          CrossedCell (&found)[SlabCells::most * SlabCells::most]) {
  const auto one = static_cast<size_t>(std::countr_zero(active));
  // These cross few cells: to find out which takes as long as to look at all.
  if (std::max(std::abs(path.slope[0][one]), std::abs(path.slope[1][one])) < least_crossing_slope) {
    size_t count = 0;
    for (int32_t j = cells.first[1]; j <= cells.last[1]; ++j)
      for (int32_t i = cells.first[0]; i <= cells.last[0]; ++i)
        found[count++] = {{i, j}, active, 0, 1};
    return count;
  }
  return HWY_DYNAMIC_DISPATCH(crossed)(path, number, active, cells, found);
}

}  // namespace msq
#endif
