// SPDX-License-Identifier: Apache-2.0
// The faces of a cell, moved inwards and solved for x. Included once for each instruction set.
#if defined(MSQ_STRUCTURE_FOAM_WALLS_SOLVED_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_WALLS_SOLVED_PLANES_INL_H
#undef MSQ_STRUCTURE_FOAM_WALLS_SOLVED_PLANES_INL_H
#else
#define MSQ_STRUCTURE_FOAM_WALLS_SOLVED_PLANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "base/compress-inl.h"
#include "structure/foam/walls/void_work.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

/// Planes with a smaller part along x are taken to lie along it; this times the reach of x is added
/// to their margin.
constexpr float min_part = 1e-6f;

/// Four faces or more at once, in double precision.
HWY_INLINE void solve(const VoidFaces& from, VoidWork& work) {
  const hn::CappedTag<double, 8> dd;
  const hn::Rebind<float, decltype(dd)> df;
  const size_t lanes = hn::Lanes(dd), room = from.count + 2 * lanes;
  work.right.clear(room);
  work.left.clear(room);
  work.along.clear();
  const auto& m = from.rotation.m;
  const auto half = hn::Set(dd, from.half);
  const auto margin = hn::Set(df, from.margin), one = hn::Set(df, 1), zero = hn::Zero(df);
  auto most_right = zero, most_left = zero;
  for (size_t i = 0; i < from.count; i += lanes) {
    const FaceBrick::Face* faces = from.faces + i;
    FaceBrick::Face last[8];
    if (from.count - i < lanes) {
      std::copy_n(faces, from.count - i, last);
      std::fill(last + (from.count - i), last + lanes, FaceBrick::Face{});
      faces = last;
    }
    static_assert(sizeof(FaceBrick::Face) == 4 * sizeof(float));
    hn::Vec<decltype(df)> fx, fy, fz, distance;
    hn::LoadInterleaved4(df, faces->normal, fx, fy, fz, distance);
    const auto x = hn::PromoteTo(dd, fx), y = hn::PromoteTo(dd, fy), z = hn::PromoteTo(dd, fz);
    const auto turned = [&](size_t row, double tilt) {
      const auto sum =
          hn::Add(hn::Mul(hn::Set(dd, m[row]), x), hn::Mul(hn::Set(dd, m[row + 1]), y));
      return hn::DemoteTo(
          df, hn::Add(hn::Add(sum, hn::Mul(hn::Set(dd, m[row + 2]), z)), hn::Set(dd, tilt)));
    };
    const auto nx = turned(0, from.tilt.x), ny = turned(3, from.tilt.y),
               nz = turned(6, from.tilt.z);
    const auto offset = hn::DemoteTo(df, hn::Sub(hn::PromoteTo(dd, distance), half));
    const auto inverse = hn::Div(one, nx);
    const auto base = hn::Mul(offset, inverse), y_slope = hn::Mul(ny, inverse),
               z_slope = hn::Mul(nz, inverse), shift = hn::Mul(margin, inverse);
    const auto is_face = hn::FirstN(df, from.count - i);
    const auto put = [&](hn::Mask<decltype(df)> which, SidePlanes& side) {
      const Compression<decltype(df)> chosen(which);
      hn::StoreU(chosen(base), df, &side.base[side.count]);
      hn::StoreU(chosen(y_slope), df, &side.y_slope[side.count]);
      hn::StoreU(chosen(z_slope), df, &side.z_slope[side.count]);
      hn::StoreU(chosen(shift), df, &side.shift[side.count]);
      hn::StoreU(chosen(hn::Sub(base, shift)), df, &side.inner[side.count]);
      side.count += hn::CountTrue(df, which);
    };
    const auto is_right = hn::And(is_face, hn::Gt(nx, hn::Set(df, min_part))),
               is_left = hn::And(is_face, hn::Lt(nx, hn::Set(df, -min_part)));
    put(is_right, work.right);
    put(is_left, work.left);
    most_right = hn::Max(most_right, hn::IfThenElse(is_right, shift, zero));
    most_left = hn::Min(most_left, hn::IfThenElse(is_left, shift, zero));
    const auto is_along = hn::AndNot(hn::Or(is_right, is_left), is_face);
    if (HWY_UNLIKELY(!hn::AllFalse(df, is_along)))
      for (size_t k = i; k < std::min(from.count, i + lanes); ++k)
        if (const VoidPlane plane = from.plane(k); std::abs(plane.n[0]) <= min_part)
          work.along.push_back(plane);
  }
  work.right.most = hn::GetLane(hn::MaxOfLanes(df, most_right));
  work.left.most = -hn::GetLane(hn::MinOfLanes(df, most_left));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
