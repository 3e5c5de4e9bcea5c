// SPDX-License-Identifier: Apache-2.0
// The coordinates of functional structures: angles, 2 pi times the position in the cell, in cells
// of one size or of a graded period.
#pragma once

#include <optional>

#include "base/vec.h"
#include "cell/graded_period.h"
#include "cell/neighbourhood.h"
#include "structure/functional/row_kernels.h"

namespace msq {

/// The grid with the smallest of the period's cells.
Neighbourhood smallest_cells(Neighbourhood grid, const std::optional<GradedPeriod>& period);
double largest_cell(const Neighbourhood& grid, const std::optional<GradedPeriod>& period);

inline Vec3 angles_of(Vec3 fraction) {
  return {angle_of(fraction.x), angle_of(fraction.y), angle_of(fraction.z)};
}

class CellAngles {
 public:
  /// `grid`: that of smallest_cells().
  CellAngles(const Neighbourhood& grid, std::optional<GradedPeriod> period)
      : grid_(grid), period_(std::move(period)) {}

  const std::optional<GradedPeriod>& period() const { return period_; }
  /// The coordinate of a point along the period's axis.
  double position(Vec3 p) const { return grid_.to_grid(p)[period_->axis()]; }

  /// The position in the cell, 0 to 1, and the angles: the definition.
  Vec3 fraction(Vec3 p) const;
  Vec3 at(Vec3 p) const { return angles_of(fraction(p)); }
  /// The same for many points, to the last bit. x, y, z and the angles are `count` values; uniform
  /// coordinates are allowed.
  void find(Values x, Values y, Values z, size_t count, double* const (&angles)[3]) const;
  CellIndex cell_of(Vec3 p) const;

  /// Of the cells at a point.
  Vec3 sizes(Vec3 p) const;
  /// Bound on the rounding of the number of cells, in addition to that of the position, for points
  /// within that distance of p.
  double error(Vec3 p, double distance) const;

 private:
  Neighbourhood grid_;
  std::optional<GradedPeriod> period_;
};

}  // namespace msq
