// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/packet_path.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(cross);

SlabCrossing cross_slab(const PacketPath& path, const PathSlab& slab, uint32_t live,
                        RayPacket& packet) {
  return HWY_DYNAMIC_DISPATCH(cross)(path, slab, live, packet);
}

}  // namespace msq
#endif
