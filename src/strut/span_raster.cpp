// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/span_raster.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/sample_bounds.h"
#include "base/simd.h"
#include "strut/fast_spans-inl.h"
#include "strut/general_spans-inl.h"
#include "strut/span_raster.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

template <Radii radii>
HWY_NOINLINE void draw_struts(const RasterTarget& target, const StrutBatch& batch,
                              const StrutSetups& setups, DoubtfulSpans& doubts) {
  FastSpans<radii> spans(target, batch, setups, doubts);
  for (size_t i = 0; i < batch.count; ++i) {
    const auto index = [&](const int32_t* values) { return static_cast<size_t>(values[i]); };
    switch (setups.kernel[i]) {
      case StrutSetups::few:
        spans.add_few(i);
        break;
      case StrutSetups::fast:
        spans.add(i);
        break;
      case StrutSetups::general:
        general::write_rows(
            target, batch, i,
            {index(setups.j0), index(setups.j1), index(setups.k0), index(setups.k1)}, doubts);
        break;
    }
  }
  spans.draw();
}

void raster_struts(const RasterTarget& target, const StrutBatch& batch, bool varying,
                   DoubtfulSpans& doubts) {
  const Borrowed<StrutSetups> borrowed;
  StrutSetups& setups = *borrowed;
  set_up_struts(target, batch, setups);
  if (!varying)
    draw_struts<Radii::constant>(target, batch, setups, doubts);
  else if (batch.linear)
    draw_struts<Radii::linear>(target, batch, setups, doubts);
  else
    draw_struts<Radii::bounded>(target, batch, setups, doubts);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(raster_struts);

SpanRaster::SpanRaster(const RowBlock& rows, AliveRows alive)
    : rows_(rows), are_all_alive_(alive == AliveRows::all) {
  const SampleGrid& grid = *rows.grid;
  SampleBounds at{0, grid.nx, rows.y0, rows.y1, rows.z0, rows.z1};
  if (!are_all_alive_ && !find_bounds(rows, at)) return;
  empty_ = false;
  box_ = {grid.at(at.i0, at.j0, at.k0), grid.at(at.i1 - 1, at.j1 - 1, at.k1 - 1)};
  samples_ = static_cast<double>(at.i1 - at.i0) * static_cast<double>(at.j1 - at.j0) *
             static_cast<double>(at.k1 - at.k0);

  for (uint64_t j = rows.y0; j < rows.y1; ++j) y_.push_back(grid.y(j));
  for (uint64_t k = rows.z0; k < rows.z1; ++k) z_.push_back(grid.z(k));
  y_.resize(y_.size() + max_simd_doubles, y_.back());
  // One more cache line per layer: neighbouring layers then use different cache sets.
  layer_words_ = rows.rows() * rows.row_words() + 8;
  certain_->assign(rows.layers() * layer_words_ + 1, 0);  // a word of room for unaligned writes
}

RasterTarget SpanRaster::target(double margin) {
  const SampleGrid& grid = *rows_.grid;
  RasterTarget target;
  target.y = y_.data();
  target.z = z_.data();
  target.rows = rows_.rows();
  target.layers = rows_.layers();
  target.row_words = rows_.row_words();
  target.layer_words = layer_words_;
  target.certain = certain_->data();
  target.x0 = grid.x(0);
  target.inverse_dx = 1 / grid.spacing.x;
  target.dy = grid.spacing.y;
  target.dz = grid.heights ? 0 : grid.spacing.z;
  target.last = static_cast<double>(grid.nx - 1);
  target.slack = 1e-9 + 0x1p-50 * static_cast<double>(grid.first[0] + grid.nx);
  target.margin = margin;
  return target;
}

void SpanRaster::draw(const RasterTarget& target, const StrutBatch& struts, DoubtfulSpans& doubts) {
  bool varying = false;
  for (size_t i = 0; i < struts.count; ++i) varying |= struts.low[i] != struts.high[i];
  HWY_DYNAMIC_DISPATCH(raster_struts)(target, struts, varying, doubts);
}

void SpanRaster::leave(Sample sample) {
  // Struts that share a surface leave the same samples undecided.
  if (left_.size() == max_left_) {
    std::sort(left_.begin(), left_.end());
    left_.erase(std::unique(left_.begin(), left_.end()), left_.end());
    max_left_ = std::max(max_left_, 2 * left_.size());
  }
  left_.push_back(sample);
}

}  // namespace msq
#endif  // HWY_ONCE
