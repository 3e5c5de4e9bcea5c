// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_gates.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "slice/contour_gates.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// Edges of crossings, one in a lane.
struct Edges {
  M are_horizontal, start_inside;
  V low, high;  // their ends, a margin away from nodes
  V line;       // where they lie across their direction
};

class EdgesOfRings {
 public:
  EdgesOfRings(const RingCrossings& crossings, const RingNodes& nodes)
      : crossings_(crossings), nodes_(nodes) {}

  HWY_INLINE Edges at(size_t i) const {
    const D d;
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<uint32_t, D> du32;
    const hn::Rebind<uint8_t, D> du8;
    const auto cells = hn::LoadU(du, crossings_.cells + i);
    const auto kinds = hn::PromoteTo(du, hn::PromoteTo(du32, hn::LoadU(du8, crossings_.kinds + i)));
    const auto has = [&](uint8_t bit) HWY_ATTR {
      return hn::RebindMask(d, hn::TestBit(kinds, hn::Set(du, uint64_t{bit})));
    };
    const M are_horizontal = has(ring_kind::horizontal),
            start_inside = has(ring_kind::first_inside);
    // Whole numbers below 2^52, and the same from the first inner node on.
    constexpr double shift = 0x1p52;
    const auto number = [&](auto bits, uint32_t first) HWY_ATTR {
      const V shifted = hn::BitCast(d, hn::Or(bits, hn::BitCast(du, hn::Set(d, shift))));
      return hn::Sub(shifted, hn::Set(d, shift + static_cast<double>(first)));
    };
    const V column = number(hn::And(cells, hn::Set(du, uint64_t{UINT32_MAX})), nodes_.first_column);
    const V row = number(hn::ShiftRight<32>(cells), nodes_.first_row);
    const V one = hn::Set(d, 1.0), pitch = hn::Set(d, nodes_.pitch);
    const V margin = hn::Set(d, nodes_.margin);
    const V u = hn::Set(d, nodes_.first_u), v = hn::Set(d, nodes_.first_v);
    const V along = hn::IfThenElse(are_horizontal, column, row);
    const V first = hn::IfThenElse(are_horizontal, u, v);
    // The boundary enters the cell through its far side where it goes down or to the left.
    const V step = hn::IfThenElse(are_horizontal, hn::IfThenZeroElse(start_inside, one),
                                  hn::IfThenElseZero(start_inside, one));
    const V across = hn::Add(hn::IfThenElse(are_horizontal, row, column), step);
    const auto node = [&](V start, V n) HWY_ATTR { return hn::Add(start, hn::Mul(n, pitch)); };
    return {are_horizontal, start_inside, hn::Add(node(first, along), margin),
            hn::Sub(node(first, hn::Add(along, one)), margin),
            node(hn::IfThenElse(are_horizontal, v, u), across)};
  }

 private:
  const RingCrossings& crossings_;
  const RingNodes& nodes_;
};

void place_crossings(const RingCrossings& crossings, const RingNodes& nodes, const double* ends,
                     double* x, double* y) {
  const D d;
  const EdgesOfRings edges(crossings, nodes);
  for (size_t i = 0; i < crossings.count; i += hn::Lanes(d)) {
    const Edges e = edges.at(i);
    const V end = hn::LoadU(d, ends + i);
    const V place = hn::IfThenElse(e.start_inside, hn::Neg(end), end);
    const V at = hn::Min(hn::Max(place, e.low), e.high);
    hn::StoreU(hn::IfThenElse(e.are_horizontal, at, e.line), d, x + i);
    hn::StoreU(hn::IfThenElse(e.are_horizontal, e.line, at), d, y + i);
  }
}

void find_gates(const RingCrossings& crossings, const RingNodes& nodes, const double* x,
                const double* y, double tolerance, Vec2* at, LineGate* gates) {
  const D d;
  const EdgesOfRings edges(crossings, nodes);
  const V limit = hn::Set(d, tolerance);
  for (size_t i = 0; i < crossings.count; i += hn::Lanes(d)) {
    const Edges e = edges.at(i);
    const V at_x = hn::LoadU(d, x + i), at_y = hn::LoadU(d, y + i);
    const V middle = hn::IfThenElse(e.are_horizontal, at_x, at_y);
    const V low = hn::Max(hn::Sub(middle, limit), e.low);
    const V high = hn::Min(hn::Add(middle, limit), e.high);
    const V left = hn::IfThenElse(e.start_inside, low, high);
    const V right = hn::IfThenElse(e.start_inside, high, low);
    hn::StoreInterleaved2(at_x, at_y, d, &at[i].x);
    hn::StoreInterleaved4(hn::IfThenElse(e.are_horizontal, left, at_x),
                          hn::IfThenElse(e.are_horizontal, right, at_x),
                          hn::IfThenElse(e.are_horizontal, at_y, left),
                          hn::IfThenElse(e.are_horizontal, at_y, right), d, &gates[i].left_x);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(place_crossings);
HWY_EXPORT(find_gates);

}  // namespace

void place_crossings(const RingCrossings& crossings, const RingNodes& nodes, const double* ends,
                     double* x, double* y) {
  HWY_DYNAMIC_DISPATCH(place_crossings)(crossings, nodes, ends, x, y);
}

void find_gates(const RingCrossings& crossings, const RingNodes& nodes, const double* x,
                const double* y, double tolerance, Vec2* at, LineGate* gates) {
  HWY_DYNAMIC_DISPATCH(find_gates)(crossings, nodes, x, y, tolerance, at, gates);
}

}  // namespace msq
#endif  // HWY_ONCE
