// SPDX-License-Identifier: Apache-2.0
// What a strut's radius may be at the samples that the strut may contain.
//
// The slopes of a field in a box that holds several struts give each of them a linear function and
// a bound of the radius' departure from it. That needs one evaluation for each strut. If many
// samples are in doubt, the struts are halved, so boxes get smaller.
#pragma once

#include "base/sample_grid.h"
#include "field/field.h"
#include "strut/strut_batch.h"

namespace msq {

class RadiusBounds {
 public:
  /// `margin`: of radii. `samples`: the box of the samples, which are part of `grid`; only the
  /// speed depends on them.
  RadiusBounds(const Parameter& radius, double margin, const SampleGrid& grid, const Box3& samples);

  /// Sets the radii of a batch. Struts have the radius times `factor`.
  void set(StrutBatch& batch, double factor) const;

 private:
  struct Work;
  /// Struts begin ... end - 1 of the order. before: the samples that were in doubt.
  void bound(Work& work, size_t begin, size_t end, double before) const;
  void use_slopes(Work& work, const Slopes& slopes, size_t begin, size_t end) const;
  void use_range(Work& work, size_t strut) const;
  /// About how many samples are in doubt for a strut.
  double doubts(const StrutBatch& batch, size_t strut) const;
  double reach(double radius) const;

  const Parameter& radius_;
  double margin_, per_volume_;
  Box3 samples_;
};

}  // namespace msq
