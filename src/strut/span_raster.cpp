// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/span_raster.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/simd.h"
#include "strut/span_raster.h"

#ifndef MSQ_SPAN_RASTER_ONCE
#define MSQ_SPAN_RASTER_ONCE
namespace msq {

/// What the kernel needs of a raster.
struct RasterTarget {
  const double *y, *z;  // rows and layers
  size_t rows, layers, words;
  uint64_t *certain, *doubt;
  double x0, inverse_dx;  // column i is at x0 + i / inverse_dx
  double last;            // last column
  double slack;           // in columns: the rounding of a column number, with room
};

}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

struct Spans {
  V low, high;  // empty where low > high
};

/// The axis of a capsule, from a; x is relative to a.x.
struct Axis {
  double dx, dy, dz, length, ux, uy, uz, across;  // across = uy^2 + uz^2
  bool is_point, along_x;
};

/// Where rows at (v, w) from a, in y and z, meet the capsule: the hull of what they meet of the two
/// end spheres and of the cylinder between the end planes. k, m, rho2: k = v uz - w uy,
/// m = v uy + w uz, rho2 = v^2 + w^2.
HWY_INLINE Spans capsule_spans(const Axis& axis, double r, V v, V w, V k, V m, V rho2) {
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
  if (axis.along_x) {  // the row runs within it for ever, or never meets it
    has_body = has_a;
    body_low = hn::Neg(inf);
    body_high = inf;
  } else {
    const V across = hn::Set(d, axis.across), ux = hn::Set(d, axis.ux);
    const V under = hn::Sub(hn::Mul(across, r2), hn::Mul(k, k));
    has_body = hn::Ge(under, zero);
    const V root = hn::Sqrt(hn::Max(under, zero));
    const V mid = hn::Mul(m, ux);
    if (axis.across > 1e-2) {
      const V inverse = hn::Set(d, 1 / axis.across);
      body_low = hn::Mul(hn::Sub(mid, root), inverse);
      body_high = hn::Mul(hn::Add(mid, root), inverse);
    } else {
      // Nearly along x: the roots by the form that does not cancel.
      const V c = hn::Sub(hn::Add(hn::Mul(k, k), hn::Mul(hn::Mul(ux, ux), rho2)), r2);
      const V q = hn::Add(mid, hn::CopySign(root, mid));
      const auto flat = hn::Eq(q, zero);  // then both roots are 0
      const V x1 = hn::Div(q, across);
      const V x2 = hn::IfThenElse(flat, zero, hn::Div(c, hn::IfThenElse(flat, across, q)));
      body_low = hn::Min(x1, x2);
      body_high = hn::Max(x1, x2);
    }
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

HWY_INLINE Axis axis_of(const RasterStrut& strut) {
  Axis axis;
  const Vec3 ab = strut.b - strut.a;
  axis.dx = ab.x;
  axis.dy = ab.y;
  axis.dz = ab.z;
  axis.length = length(ab);
  // A segment shorter than a millionth of a margin's worth of radius is a sphere.
  axis.is_point = !(axis.length > 1e-14 * strut.high);
  const double inverse = axis.is_point ? 0 : 1 / axis.length;
  axis.ux = ab.x * inverse;
  axis.uy = ab.y * inverse;
  axis.uz = ab.z * inverse;
  axis.across = axis.uy * axis.uy + axis.uz * axis.uz;
  axis.along_x = axis.across < 1e-28;
  return axis;
}

void raster_struts(const RasterTarget& target, const RasterStrut* struts, size_t count,
                   double margin) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  HWY_ALIGN double column[4][most_simd_doubles];
  for (size_t s = 0; s < count; ++s) {
    const RasterStrut& strut = struts[s];
    const double thick = strut.high + margin, thin = strut.low - margin;
    const double *y_end = target.y + target.rows, *z_end = target.z + target.layers;
    const size_t j0 = std::lower_bound(target.y, y_end, std::min(strut.a.y, strut.b.y) - thick) -
                      target.y;
    const size_t j1 = std::upper_bound(target.y, y_end, std::max(strut.a.y, strut.b.y) + thick) -
                      target.y;
    const size_t k0 = std::lower_bound(target.z, z_end, std::min(strut.a.z, strut.b.z) - thick) -
                      target.z;
    const size_t k1 = std::upper_bound(target.z, z_end, std::max(strut.a.z, strut.b.z) + thick) -
                      target.z;
    if (j0 >= j1 || k0 >= k1) continue;
    const Axis axis = axis_of(strut);
    const V shift = hn::Set(d, strut.a.x - target.x0), scale = hn::Set(d, target.inverse_dx);
    const V slack = hn::Set(d, target.slack), last = hn::Set(d, target.last);
    const V minus_one = hn::Set(d, -1.0);
    const V beyond = hn::Set(d, target.last + 1);

    for (size_t k = k0; k < k1; ++k) {
      const V w = hn::Set(d, target.z[k] - strut.a.z);
      for (size_t j = j0; j < j1; j += lanes) {
        // y_ is padded by a vector; lanes past j1 are computed and not used.
        const V v = hn::Sub(hn::LoadU(d, target.y + j), hn::Set(d, strut.a.y));
        const V uy = hn::Set(d, axis.uy), uz = hn::Set(d, axis.uz);
        const V cross = hn::Sub(hn::Mul(v, uz), hn::Mul(w, uy));
        const V along = hn::Add(hn::Mul(v, uy), hn::Mul(w, uz));
        const V rho2 = hn::Add(hn::Mul(v, v), hn::Mul(w, w));
        const Spans outer = capsule_spans(axis, thick, v, w, cross, along, rho2);
        if (hn::AllFalse(d, hn::Le(outer.low, outer.high))) continue;
        Spans inner{beyond, minus_one};
        if (thin > 0) inner = capsule_spans(axis, thin, v, w, cross, along, rho2);

        // First and last column; clamped so that empty spans stay empty and all fit an integer.
        const auto first_column = [&](V x, V inwards) {
          const V c = hn::Ceil(hn::Add(hn::Mul(hn::Add(x, shift), scale), inwards));
          return hn::Min(hn::Max(c, hn::Zero(d)), beyond);
        };
        const auto last_column = [&](V x, V inwards) {
          const V c = hn::Floor(hn::Sub(hn::Mul(hn::Add(x, shift), scale), inwards));
          return hn::Max(hn::Min(c, last), minus_one);
        };
        hn::Store(first_column(outer.low, hn::Neg(slack)), d, column[0]);
        hn::Store(last_column(outer.high, hn::Neg(slack)), d, column[1]);
        hn::Store(first_column(inner.low, slack), d, column[2]);
        hn::Store(last_column(inner.high, slack), d, column[3]);
        const size_t used = std::min(lanes, j1 - j);
        for (size_t lane = 0; lane < used; ++lane) {
          const int64_t o0 = static_cast<int64_t>(column[0][lane]);
          const int64_t o1 = static_cast<int64_t>(column[1][lane]);
          if (o0 > o1) continue;
          const int64_t i0 = static_cast<int64_t>(column[2][lane]);
          const int64_t i1 = static_cast<int64_t>(column[3][lane]);
          const size_t at = (k * target.rows + j + lane) * target.words;
          if (i0 > i1) {
            set_bits(target.doubt + at, o0, o1);
            continue;
          }
          set_bits(target.certain + at, i0, i1);
          if (o0 < i0) set_bits(target.doubt + at, o0, i0 - 1);
          if (i1 < o1) set_bits(target.doubt + at, i1 + 1, o1);
        }
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(raster_struts);

SpanRaster::SpanRaster(const RowBlock& alive, double margin) : alive_(alive), margin_(margin) {
  const SampleGrid& grid = *alive.grid;
  const size_t words = alive.row_words();
  uint64_t j0 = alive.y1, j1 = alive.y0, k0 = alive.z1, k1 = alive.z0;
  std::vector<uint64_t> any(words, 0);
  for (uint64_t k = alive.z0; k < alive.z1; ++k)
    for (uint64_t j = alive.y0; j < alive.y1; ++j) {
      const uint64_t* row = alive.row(j, k);
      uint64_t some = 0;
      for (size_t w = 0; w < words; ++w) {
        any[w] |= row[w];
        some |= row[w];
      }
      if (!some) continue;
      j0 = std::min(j0, j);
      j1 = std::max(j1, j + 1);
      k0 = std::min(k0, k);
      k1 = std::max(k1, k + 1);
    }
  if (j0 >= j1) return;
  empty_ = false;
  size_t w0 = 0, w1 = words;
  while (!any[w0]) ++w0;
  while (!any[w1 - 1]) --w1;
  const uint64_t i0 = w0 * bits_per_word, i1 = std::min<uint64_t>(w1 * bits_per_word, grid.nx);
  box_ = {grid.at(i0, j0, k0), grid.at(i1 - 1, j1 - 1, k1 - 1)};

  for (uint64_t j = alive.y0; j < alive.y1; ++j) y_.push_back(grid.y(j));
  for (uint64_t k = alive.z0; k < alive.z1; ++k) z_.push_back(grid.z(k));
  y_.resize(y_.size() + most_simd_doubles, y_.back());
  const size_t size = alive.rows() * alive.layers() * words;
  certain_.assign(size, 0);
  doubt_.assign(size, 0);
}

void SpanRaster::add(const RasterStrut* struts, size_t count) {
  const SampleGrid& grid = *alive_.grid;
  RasterTarget target;
  target.y = y_.data();
  target.z = z_.data();
  target.rows = alive_.rows();
  target.layers = alive_.layers();
  target.words = alive_.row_words();
  target.certain = certain_.data();
  target.doubt = doubt_.data();
  target.x0 = grid.origin.x;
  target.inverse_dx = 1 / grid.spacing.x;
  target.last = static_cast<double>(grid.nx - 1);
  target.slack = 1e-9 + 0x1p-50 * static_cast<double>(grid.nx);
  HWY_DYNAMIC_DISPATCH(raster_struts)(target, struts, count, margin_);
}

}  // namespace msq
#endif  // HWY_ONCE
