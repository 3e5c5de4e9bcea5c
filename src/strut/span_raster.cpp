// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/span_raster.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/simd.h"
#include "strut/fast_spans-inl.h"
#include "strut/general_spans-inl.h"
#include "strut/span_raster.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// Indices of evenly spaced values (or, with step 0, of any) that may lie in [low, high]. One too
/// many does no harm.
HWY_INLINE void index_range(const double* values, size_t count, double step, double low,
                            double high, size_t& first, size_t& last) {
  if (step > 0) {
    const double inverse = 1 / step, most = static_cast<double>(count);
    const double a = std::ceil((low - values[0]) * inverse - 1e-3);
    const double b = std::floor((high - values[0]) * inverse + 1e-3) + 1;
    first = static_cast<size_t>(std::min(std::max(a, 0.0), most));
    last = static_cast<size_t>(std::min(std::max(b, 0.0), most));
  } else {
    first = static_cast<size_t>(std::lower_bound(values, values + count, low) - values);
    last = static_cast<size_t>(std::upper_bound(values, values + count, high) - values);
  }
}

HWY_INLINE RowRange rows_of(const RasterTarget& target, const RasterStrut& strut) {
  const double thick = strut.high + target.margin;
  RowRange range;
  index_range(target.y, target.rows, target.dy, std::min(strut.a.y, strut.b.y) - thick,
              std::max(strut.a.y, strut.b.y) + thick, range.j0, range.j1);
  index_range(target.z, target.layers, target.dz, std::min(strut.a.z, strut.b.z) - thick,
              std::max(strut.a.z, strut.b.z) + thick, range.k0, range.k1);
  return range;
}

void raster_struts(const RasterTarget& target, const RasterStrut* struts, size_t count) {
  const size_t lanes = hwy::HWY_NAMESPACE::Lanes(fast::D());
  for (const RasterStrut* strut = struts; strut != struts + count; ++strut) {
    const RowRange range = rows_of(target, *strut);
    if (range.j0 >= range.j1 || range.k0 >= range.k1) continue;
    const CapsuleAxis axis(strut->a, strut->b, strut->high);
    if (strut->low != strut->high || !fast::serves(target, *strut, axis)) {
      general::write_rows(target, *strut, axis, range);
      continue;
    }
    // Few rows: several layers to a vector.
    size_t wide = lanes;
    if (target.dz > 0)
      while (wide > 4 && range.j1 - range.j0 <= wide / 2) wide /= 2;
    fast::write_rows(target, *strut, axis, range, wide);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(raster_struts);

SpanRaster::SpanRaster(const RowBlock& alive) : alive_(alive) {
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
  const uint64_t i0 = w0 * bits_per_word + static_cast<unsigned>(std::countr_zero(any[w0]));
  const uint64_t i1 = w1 * bits_per_word - static_cast<unsigned>(std::countl_zero(any[w1 - 1]));
  box_ = {grid.at(i0, j0, k0), grid.at(i1 - 1, j1 - 1, k1 - 1)};
  samples_ =
      static_cast<double>(i1 - i0) * static_cast<double>(j1 - j0) * static_cast<double>(k1 - k0);

  for (uint64_t j = alive.y0; j < alive.y1; ++j) y_.push_back(grid.y(j));
  for (uint64_t k = alive.z0; k < alive.z1; ++k) z_.push_back(grid.z(k));
  y_.resize(y_.size() + most_simd_doubles, y_.back());
  const size_t size = alive.rows() * alive.layers() * words;
  certain_.assign(size + 1, 0);  // a word of room for unaligned writes
  doubt_.assign(size, 0);
}

void SpanRaster::add(const RasterStrut* struts, size_t count, double margin) {
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
  target.dy = grid.spacing.y;
  target.dz = grid.heights ? 0 : grid.spacing.z;
  target.last = static_cast<double>(grid.nx - 1);
  target.slack = 1e-9 + 0x1p-50 * static_cast<double>(grid.nx);
  target.margin = margin;
  HWY_DYNAMIC_DISPATCH(raster_struts)(target, struts, count);
}

}  // namespace msq
#endif  // HWY_ONCE
