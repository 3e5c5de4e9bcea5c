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
constexpr size_t no_square = SIZE_MAX;

/// A few points, each with its square.
struct PointsInSquares {
  double x[points_at_once + max_simd_doubles], y[points_at_once + max_simd_doubles];
  size_t squares[points_at_once];
  size_t count;
};
struct SquareLists {
  const PlaneStrut* struts;
  const uint32_t *starts, *lists;  // by square
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
void find_in_squares(const PointsInSquares& points, const SquareLists& of,
                     PlaneStruts::Found* found) {
  using Found = PlaneStruts::Found;
  static_assert(static_cast<int>(Found::outside) == 0 && static_cast<int>(Found::inside) == 1 &&
                static_cast<int>(Found::doubtful) == 2);
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const size_t lanes = hn::Lanes(d);
  const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
  const V zero = hn::Zero(d), one = set(1);
  for (size_t n = 0; n < points.count;) {
    const size_t square = points.squares[n];
    if (square == no_square) {
      found[n++] = Found::doubtful;
      continue;
    }
    size_t end = n + 1;
    const size_t most = std::min(points.count, n + lanes);
    while (end < most && points.squares[end] == square) ++end;
    const V p_x = hn::LoadU(d, points.x + n), p_y = hn::LoadU(d, points.y + n);
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
  const SquareLists lists{memory_->struts.data(), memory_->starts.data(), memory_->lists.data(),
                          margin_};
  PointsInSquares some;
  std::fill(std::begin(some.x), std::end(some.x), 0.0);
  std::fill(std::begin(some.y), std::end(some.y), 0.0);
  for (size_t done = 0; done < count; done += points_at_once) {
    some.count = std::min(count - done, points_at_once);
    for (size_t n = 0; n < some.count; ++n) {
      const Vec2 p = points[done + n];
      const bool is_known = p.x >= u_.low && p.x <= u_.high && p.y >= v_.low && p.y <= v_.high;
      some.x[n] = p.x;
      some.y[n] = p.y;
      some.squares[n] = is_known ? size_t{v_.at(p.y)} * u_.count + u_.at(p.x) : no_square;
    }
    // Most of the time would go by waiting for struts, one after the other.
    size_t last = no_square;
    for (size_t n = 0; n < some.count; ++n) {
      const size_t square = some.squares[n];
      if (square == last || square == no_square) continue;
      last = square;
      for (uint32_t i = lists.starts[square]; i < lists.starts[square + 1]; ++i)
        hwy::Prefetch(lists.struts + lists.lists[i]);
    }
    HWY_DYNAMIC_DISPATCH(find_in_squares)(some, lists, found + done);
  }
}

size_t PlaneStruts::Memory::bytes() const {
  return struts.capacity() * sizeof(PlaneStrut) + parts.capacity() * sizeof(AxisPart) +
         squares.capacity() * sizeof(SquareRange) +
         (starts.capacity() + lists.capacity()) * sizeof(uint32_t);
}

}  // namespace msq
#endif  // HWY_ONCE
