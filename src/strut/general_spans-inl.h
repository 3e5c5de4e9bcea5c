// SPDX-License-Identifier: Apache-2.0
// Spans of any capsule, for any two radii, in double precision: the raster's careful kernel.
// Included once for each instruction set.
#if defined(MSQ_STRUT_GENERAL_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_GENERAL_SPANS_INL_H
#undef MSQ_STRUT_GENERAL_SPANS_INL_H
#else
#define MSQ_STRUT_GENERAL_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include "base/sample_grid.h"
#include "base/simd.h"
#include "strut/raster_target.h"
#include "strut/strut_batch.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace general {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

struct Spans {
  V low, high;  // empty where low > high
};

/// The spans in which rows at offsets (v, w) from a, in y and z, meet the capsule. A span is the
/// hull of the intersections with the two end spheres and with the cylinder between the end planes.
/// k = v uz - w uy, m = v uy + w uz, rho2 = v^2 + w^2.
HWY_INLINE Spans capsule_spans(const CapsuleAxis& axis, double r, V v, V w, V k, V m, V rho2) {
  const D d;
  const V zero = hn::Zero(d), inf = hn::Set(d, 1e300), r2 = hn::Set(d, r * r);

  const V under_a = hn::Sub(r2, rho2);
  const V half_a = hn::Sqrt(hn::Max(under_a, zero));
  const auto has_a = hn::Ge(under_a, zero);
  V low = hn::IfThenElse(has_a, hn::Neg(half_a), inf);
  V high = hn::IfThenElse(has_a, half_a, hn::Neg(inf));
  if (axis.is_point) return {low, high};

  const V vb = hn::Sub(v, hn::Set(d, axis.dy)), wb = hn::Sub(w, hn::Set(d, axis.dz));
  const V under_b = hn::Sub(r2, hn::Add(hn::Mul(vb, vb), hn::Mul(wb, wb)));
  const V half_b = hn::Sqrt(hn::Max(under_b, zero));
  const auto has_b = hn::Ge(under_b, zero);
  const V dx = hn::Set(d, axis.dx);
  low = hn::Min(low, hn::IfThenElse(has_b, hn::Sub(dx, half_b), inf));
  high = hn::Max(high, hn::IfThenElse(has_b, hn::Add(dx, half_b), hn::Neg(inf)));

  // The infinite cylinder: across X^2 - 2 m ux X + (k^2 + ux^2 rho2 - r^2) <= 0, whose quarter
  // discriminant is across r^2 - k^2.
  V body_low, body_high;
  hn::Mask<D> has_body;
  if (axis.along_x) {  // the row runs within it forever, or never meets it
    has_body = has_a;
    body_low = hn::Neg(inf);
    body_high = inf;
  } else {
    const V across = hn::Set(d, axis.across), ux = hn::Set(d, axis.ux);
    const V under = hn::Sub(hn::Mul(across, r2), hn::Mul(k, k));
    has_body = hn::Ge(under, zero);
    const V root = hn::Sqrt(hn::Max(under, zero));
    // Roots by the form without cancellation when the strut is nearly along x.
    const V mid = hn::Mul(m, ux);
    const V c = hn::Sub(hn::Add(hn::Mul(k, k), hn::Mul(hn::Mul(ux, ux), rho2)), r2);
    const V q = hn::Add(mid, hn::CopySign(root, mid));
    const auto flat = hn::Eq(q, zero);  // then both roots are 0
    const V x1 = hn::Div(q, across);
    const V x2 = hn::IfThenElse(flat, zero, hn::Div(c, hn::IfThenElse(flat, across, q)));
    body_low = hn::Min(x1, x2);
    body_high = hn::Max(x1, x2);
  }
  // Between the end planes, 0 <= X ux + m <= length.
  if (std::abs(axis.ux) > 1e-12) {
    const V inverse = hn::Set(d, 1 / axis.ux);
    const V at_a = hn::Mul(hn::Neg(m), inverse);
    const V at_b = hn::Mul(hn::Sub(hn::Set(d, axis.length), m), inverse);
    body_low = hn::Max(body_low, hn::Min(at_a, at_b));
    body_high = hn::Min(body_high, hn::Max(at_a, at_b));
  } else {
    has_body = hn::And(has_body, hn::And(hn::Ge(m, zero), hn::Le(m, hn::Set(d, axis.length))));
  }
  has_body = hn::And(has_body, hn::Le(body_low, body_high));
  low = hn::Min(low, hn::IfThenElse(has_body, body_low, inf));
  high = hn::Max(high, hn::IfThenElse(has_body, body_high, hn::Neg(inf)));
  return {low, high};
}

/// Draws the span of strut `index`, thinned by the margin, into rows [range.j0, range.j1) of each
/// layer of the range. The additional samples in the span of the strut thickened by the margin are
/// doubtful.
HWY_INLINE void write_rows(const RasterTarget& target, const StrutBatch& batch, size_t index,
                           const RowRange& range, DoubtfulSpans& doubts) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const Vec3 a = batch.from(index);
  const CapsuleAxis axis(a, batch.to(index), batch.high[index]);
  const double thick = batch.high[index] + target.margin;
  const double thin = batch.low[index] - target.margin;
  const V shift = hn::Set(d, a.x - target.x0), scale = hn::Set(d, target.inverse_dx);
  const V slack = hn::Set(d, target.slack), last = hn::Set(d, target.last);
  const V minus_one = hn::Set(d, -1.0), beyond = hn::Set(d, target.last + 1);
  const V uy = hn::Set(d, axis.uy), uz = hn::Set(d, axis.uz), ay = hn::Set(d, a.y);
  HWY_ALIGN double column[4][max_simd_doubles];
  // First and last column, clamped so that empty spans stay empty and all fit an integer.
  const auto first_column = [&](V x, V inwards) {
    const V c = hn::Ceil(hn::Add(hn::Mul(hn::Add(x, shift), scale), inwards));
    return hn::Min(hn::Max(c, hn::Zero(d)), beyond);
  };
  const auto last_column = [&](V x, V inwards) {
    const V c = hn::Floor(hn::Sub(hn::Mul(hn::Add(x, shift), scale), inwards));
    return hn::Max(hn::Min(c, last), minus_one);
  };
  for (size_t k = range.k0; k < range.k1; ++k) {
    const V w = hn::Set(d, target.z[k] - a.z);
    for (size_t j = range.j0; j < range.j1; j += lanes) {
      // Lanes past j1 are computed but not used.
      const V v = hn::Sub(hn::LoadU(d, target.y + j), ay);
      const V cross = hn::Sub(hn::Mul(v, uz), hn::Mul(w, uy));
      const V along = hn::Add(hn::Mul(v, uy), hn::Mul(w, uz));
      const V rho2 = hn::Add(hn::Mul(v, v), hn::Mul(w, w));
      const Spans outer = capsule_spans(axis, thick, v, w, cross, along, rho2);
      if (hn::AllFalse(d, hn::Le(outer.low, outer.high))) continue;
      Spans inner{beyond, minus_one};
      if (thin > 0) inner = capsule_spans(axis, thin, v, w, cross, along, rho2);
      hn::Store(first_column(outer.low, hn::Neg(slack)), d, column[0]);
      hn::Store(last_column(outer.high, hn::Neg(slack)), d, column[1]);
      hn::Store(first_column(inner.low, slack), d, column[2]);
      hn::Store(last_column(inner.high, slack), d, column[3]);
      const size_t used = std::min(lanes, range.j1 - j);
      for (size_t lane = 0; lane < used; ++lane) {
        const int64_t o0 = static_cast<int64_t>(column[0][lane]);
        const int64_t o1 = static_cast<int64_t>(column[1][lane]);
        if (o0 > o1) continue;
        const int64_t i0 = static_cast<int64_t>(column[2][lane]);
        const int64_t i1 = static_cast<int64_t>(column[3][lane]);
        const auto doubt = [&](int64_t from, int64_t to) {
          if (from > to) return;
          doubts.push_back({static_cast<uint32_t>(index), static_cast<uint32_t>(j + lane),
                            static_cast<uint32_t>(k), static_cast<uint32_t>(from),
                            static_cast<uint32_t>(to - from + 1)});
        };
        if (i0 > i1) {
          doubt(o0, o1);
          continue;
        }
        set_bits(target.row(j + lane, k), i0, i1);
        doubt(o0, i0 - 1);
        doubt(i1 + 1, o1);
      }
    }
  }
}

}  // namespace general
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
