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
  /// Points whose squared distance from an axis, less the squared radius, is nearer to 0 are in
  /// doubt.
  double doubt;
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
  // Branches on each point and each strut would be predicted wrongly too often, so where groups end
  // is counted, and struts are taken by twos: of an odd number, the last one twice.
  size_t ends[points_at_once], groups = 0;
  for (size_t n = 0; n < count; ++n) {
    ends[groups] = n + 1;
    groups += n + 1 == count || squares[n + 1] != squares[n];
  }
  uint64_t are_inside = 0, are_near = 0;
  for (size_t group = 0, first = 0; group < groups; first = ends[group++]) {
    if (squares[first] == no_square) {
      are_near |= ~uint64_t{0} >> (64 - (ends[group] - first)) << first;
      continue;
    }
    const uint32_t* const starts = of.starts + static_cast<int64_t>(squares[first]);
    const uint32_t *const list = of.lists + starts[0], *const list_end = of.lists + starts[1];
    for (size_t n = first; n < ends[group]; n += lanes) {
      const V p_x = hn::LoadU(d, at_x + n), p_y = hn::LoadU(d, at_y + n);
      // The least squared distance from an axis, less the squared radius.
      V least = set(std::numeric_limits<double>::infinity());
      const auto add = [&](const PlaneStrut& s) HWY_ATTR {
        const V d_u = set(s.d_u), d_v = set(s.d_v), d_w = set(s.d_w), w = set(s.w);
        const V x = hn::Sub(p_x, set(s.a_u)), y = hn::Sub(p_y, set(s.a_v));
        const V along = hn::MulAdd(x, d_u, hn::MulAdd(y, d_v, hn::Mul(w, d_w)));
        const V part = hn::Mul(along, set(s.inverse_length_squared));
        const V t = hn::Min(hn::Max(part, zero), one);
        const V dx = hn::NegMulAdd(t, d_u, x), dy = hn::NegMulAdd(t, d_v, y);
        const V dw = hn::NegMulAdd(t, d_w, w);
        const V squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dw, dw)));
        least = hn::Min(least, hn::Sub(squared, set(s.radius * s.radius)));
      };
      for (const uint32_t* i = list; i < list_end; i += 2) {
        add(of.struts[i[0]]);
        add(of.struts[i[i + 1 < list_end]]);
      }
      // Points behind the group get bits, too. They are true, since a strut that holds a point or
      // is near it does so from any list.
      are_inside |= bits_of(d, hn::Lt(least, set(-of.doubt))) << n;
      are_near |= bits_of(d, hn::Le(least, set(of.doubt))) << n;
    }
  }
  const uint64_t are_doubtful = are_near & ~are_inside;
  for (size_t n = 0; n < count; ++n)
    found[n] = static_cast<Found>((are_inside >> n & 1) | (are_doubtful >> n & 1) << 1);
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
  // With the margin m, for each radius r up to the widest R: (r + m)^2 <= r^2 + (2 R + m) m, and
  // r^2 - (2 R + m) m <= (r - m)^2, if r >= m. Nothing is inside thinner struts.
  const double doubt = (2 * widest_ + margin_) * margin_;
  const SquareLists lists{memory_->struts.data(),
                          memory_->starts.data(),
                          memory_->lists.data(),
                          axis(u_),
                          axis(v_),
                          doubt};
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
