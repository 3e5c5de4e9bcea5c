// SPDX-License-Identifier: Apache-2.0
// The common part of the rows of strut structures: add struts, then restrict samples, for any kind
// of radius.
#pragma once

#include "cell/neighbourhood.h"
#include "field/field.h"
#include "structure/common/grid_boxes.h"
#include "structure/common/radius_bounds.h"
#include "strut/segment_selection.h"
#include "strut/span_raster.h"

namespace msq {

class StrutRows {
 public:
  /// `margin`: error of the strut ends and radii relative to the scalar predicate, in model units;
  /// the error of the positions of samples and struts is added here. `max_factor`: maximum factor
  /// of the radius of any strut.
  StrutRows(const RowBlock& block, const Neighbourhood& grid, const Parameter& radius,
            double margin, double max_factor = 1, AliveRows alive = AliveRows::some)
      : radius_(radius),
        raster_(block, alive),
        margin_(margin + position_margin(raster_.box(), grid.origin) + block.grid->rounding()),
        reach_(raster_.box().grown(max_factor * radius.range().high + margin_)),
        bounds_(radius, margin_, *block.grid, raster_.box()) {}

  /// True if no sample is alive: nothing to do.
  bool empty() const { return raster_.empty(); }
  /// Whether there are more than `critical` samples per cell in reach. If not, single points are
  /// faster, and cells without samples are not visited.
  bool pays(const Neighbourhood& grid, double critical) const {
    return pays(mean_cells_met(grid, reach_), critical);
  }
  bool pays(double cells, double critical) const { return raster_.samples() > critical * cells; }
  /// Struts whose axis does not meet this box may be left out.
  const Box3& reach() const { return reach_; }

  /// Adds a strut whose radius is the radius times `factor`. Struts of one factor are drawn
  /// together: add them one after the other.
  void add(Vec3 a, Vec3 b, double factor) {
    const Box3 extent{min(a, b), max(a, b)};
    if (!extent.overlaps(reach_)) return;
    if (factor != factor_) {
      flush();
      factor_ = factor;
    }
    batch_.push(a, b);
    if (batch_.full()) flush();
  }
  /// Adds the segments of a set that may touch `box` (the set's coordinates), with factor 1.
  void add(const SegmentSet& set, const SegmentFrame& frame, const Box3& box) {
    flush();
    factor_ = 1;
    selection_.select(set, box);
    for (size_t first = 0; first < selection_.count(); first += StrutBatch::capacity) {
      selection_.place(frame, first, batch_);
      flush();
    }
  }
  /// Draws the struts added so far.
  void flush() {
    if (batch_.count == 0) return;
    bounds_.set(batch_, factor_);
    raster_.add(batch_, margin_, [this](const Vec3* points, size_t count, double* radii) {
      radius_.values(points, count, radii);
      for (size_t i = 0; i < count; ++i) radii[i] = factor_ * radii[i];
    });
    batch_.count = 0;
  }
  /// Clears the samples outside all struts; inside(p) decides the doubtful samples.
  template <class Inside>
  void finish(const Job* job, Inside&& inside) {
    flush();
    raster_.finish(job, inside);
  }

 private:
  /// The error of positions on either side is a few units of 2^-53 of the largest magnitude; this
  /// is 2^-40.
  static double position_margin(const Box3& box, Vec3 origin) {
    return 0x1p-40 * (max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(origin));
  }

  const Parameter& radius_;
  SpanRaster raster_;
  double margin_;
  Box3 reach_;
  RadiusBounds bounds_;
  double factor_ = 1;  // of the batch
  StrutBatch batch_;
  SegmentSelection selection_;
};

}  // namespace msq
