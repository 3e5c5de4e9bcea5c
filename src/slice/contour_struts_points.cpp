// SPDX-License-Identifier: Apache-2.0
// Membership of points of the plane by its struts.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_struts_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "slice/contour_struts.h"

#ifndef MSQ_SLICE_CONTOUR_STRUTS_POINTS_ONCE
#define MSQ_SLICE_CONTOUR_STRUTS_POINTS_ONCE
namespace msq {
namespace {

/// Points that are looked up at a time.
constexpr size_t points_at_once = 64;
constexpr double no_square = -1;

/// Squares along an axis.
struct SquareAxis {
  double low, high, inverse_side, last;
};
struct SquareLists {
  const PlaneStrut* struts;
  const uint32_t *starts, *lists;  // by square
  SquareAxis u, v;
  double margin;
};

}  // namespace
}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Points come along the boundary, so several in a row share a square: its struts are looked at
/// once for a vector of them. All struts, since branches on each one would cost more.
void find_in_squares(const Vec2* points, size_t count, const SquareLists& of,
                     PlaneStruts::Found* found) {
  using Found = PlaneStruts::Found;
  static_assert(static_cast<int>(Found::outside) == 0 && static_cast<int>(Found::inside) == 1 &&
                static_cast<int>(Found::doubtful) == 2);
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const size_t lanes = hn::Lanes(d);
  const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
  const V zero = hn::Zero(d), one = set(1);
  double at_x[points_at_once + max_simd_doubles], at_y[points_at_once + max_simd_doubles];
  double squares[points_at_once + max_simd_doubles];
  const auto place_in = [&](V at, const SquareAxis& axis) HWY_ATTR {
    const V i = hn::Mul(hn::Sub(at, set(axis.low)), set(axis.inverse_side));
    return hn::Floor(hn::Min(hn::Max(i, zero), set(axis.last)));
  };
  const auto are_in = [&](V at, const SquareAxis& axis) HWY_ATTR {
    return hn::And(hn::Ge(at, set(axis.low)), hn::Le(at, set(axis.high)));
  };
  for (size_t i = 0; i < count; i += lanes) {
    V x, y;
    if (i + lanes <= count) {
      hn::LoadInterleaved2(d, &points[i].x, x, y);
    } else {
      for (size_t n = i; n < i + lanes; ++n) {
        at_x[n] = points[std::min(n, count - 1)].x;
        at_y[n] = points[std::min(n, count - 1)].y;
      }
      x = hn::LoadU(d, at_x + i);
      y = hn::LoadU(d, at_y + i);
    }
    hn::StoreU(x, d, at_x + i);
    hn::StoreU(y, d, at_y + i);
    const V square = hn::Add(hn::Mul(place_in(y, of.v), set(of.u.last + 1)), place_in(x, of.u));
    hn::StoreU(hn::IfThenElse(hn::And(are_in(x, of.u), are_in(y, of.v)), square, set(no_square)), d,
               squares + i);
  }
  // Most of the time would go by waiting for struts, one after the other.
  for (size_t n = 0; n < count; n += 4) {
    const size_t square =
        static_cast<size_t>(std::max(int64_t{0}, static_cast<int64_t>(squares[n])));
    const uint32_t first = of.starts[square], count_of = of.starts[square + 1] - first;
    for (uint32_t i = 0; i < std::min(count_of, uint32_t{4}); ++i)
      hwy::Prefetch(of.struts + of.lists[first + i]);
  }
  for (size_t n = 0; n < count;) {
    if (squares[n] == no_square) {
      found[n++] = Found::doubtful;
      continue;
    }
    size_t end = n + 1;
    const size_t most = std::min(count, n + lanes);
    while (end < most && squares[end] == squares[n]) ++end;
    const size_t square = static_cast<size_t>(static_cast<int64_t>(squares[n]));
    const V p_x = hn::LoadU(d, at_x + n), p_y = hn::LoadU(d, at_y + n);
    // The least distance from the surfaces of what is inside, and of what is near; squared.
    V inside = set(std::numeric_limits<double>::infinity()), near = inside;
    const uint32_t* const list_end = of.lists + of.starts[square + 1];
    for (const uint32_t* i = of.lists + of.starts[square]; i < list_end; ++i) {
      const PlaneStrut& s = of.struts[*i];
      const double less = s.radius - of.margin, high = s.radius + of.margin;
      const double low = less > 0 ? less : 0;
      const V d_u = set(s.d_u), d_v = set(s.d_v), d_w = set(s.d_w), w = set(s.w);
      const V x = hn::Sub(p_x, set(s.a_u)), y = hn::Sub(p_y, set(s.a_v));
      const V along = hn::MulAdd(x, d_u, hn::MulAdd(y, d_v, hn::Mul(w, d_w)));
      const V part = hn::Mul(along, set(s.inverse_length_squared));
      const V t = hn::Min(hn::Max(part, zero), one);
      const V dx = hn::NegMulAdd(t, d_u, x), dy = hn::NegMulAdd(t, d_v, y);
      const V dw = hn::NegMulAdd(t, d_w, w);
      const V squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dw, dw)));
      near = hn::Min(near, hn::Sub(squared, set(high * high)));
      inside = hn::Min(inside, hn::Sub(squared, set(low * low)));
    }
    const uint64_t are_inside = bits_of(d, hn::Lt(inside, zero));
    const uint64_t are_doubtful = bits_of(d, hn::Le(near, zero)) & ~are_inside;
    for (size_t i = 0; n < end; ++n, ++i)
      found[n] = static_cast<Found>((are_inside >> i & 1) | (are_doubtful >> i & 1) << 1);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(find_in_squares);

}  // namespace

PlaneStruts::Found PlaneStruts::find(Vec2 p) const {
  Found found;
  find(&p, 1, &found);
  return found;
}

void PlaneStruts::find(const Vec2* points, size_t count, Found* found) const {
  const auto axis = [](const Squares& s) {
    return SquareAxis{s.low, s.high, s.inverse_side, static_cast<double>(s.count - 1)};
  };
  const SquareLists lists{memory_->struts.data(),
                          memory_->starts.data(),
                          memory_->lists.data(),
                          axis(u_),
                          axis(v_),
                          margin_};
  for (size_t done = 0; done < count; done += points_at_once) HWY_DYNAMIC_DISPATCH(find_in_squares)
  (points + done, std::min(count - done, points_at_once), lists, found + done);
}

size_t PlaneStruts::Memory::bytes() const {
  return struts.capacity() * sizeof(PlaneStrut) + parts.capacity() * sizeof(AxisPart) +
         thin.capacity() * sizeof(uint32_t) + squares.capacity() * sizeof(SquareRange) +
         (starts.capacity() + lists.capacity()) * sizeof(uint32_t);
}

}  // namespace msq
#endif  // HWY_ONCE
