// SPDX-License-Identifier: Apache-2.0
// The coordinates of functional structures: angles, 2 pi times the position in the cell, in cells
// of one size, of a graded period, warped, or by a map that the host samples.
#pragma once

#include <memory>
#include <optional>

#include "base/pi.h"
#include "base/vec.h"
#include "cell/graded_period.h"
#include "cell/neighbourhood.h"
#include "cell/sampled_map.h"
#include "cell/warp.h"
#include "structure/common/cell_shell.h"
#include "structure/functional/row_kernels.h"

namespace msq {

/// What cells are made of: one of these, or none.
struct CellShape {
  CellShape() = default;
  CellShape(GradedPeriod graded) : period(std::move(graded)) {}
  CellShape(const Warp& warped) : warp(warped) {}

  std::optional<GradedPeriod> period;
  std::optional<Warp> warp;
  std::shared_ptr<const SampledMap> sampled;
};

/// The grid with the smallest of the period's cells; with boxes in place of warped cells, as long
/// as those are outwards and, around an axis, along it. As far as indices of these boxes are
/// limited, those of warped cells are below twice that. Of a sampled map, SampledMap::smallest().
Neighbourhood smallest_cells(Neighbourhood grid, const CellShape& shape);
double largest_cell(const Neighbourhood& grid, const CellShape& shape);

inline Vec3 angles_of(Vec3 fraction) {
  return {angle_of(fraction.x), angle_of(fraction.y), angle_of(fraction.z)};
}

class CellAngles {
 public:
  /// `grid`: that of smallest_cells().
  CellAngles(const Neighbourhood& grid, CellShape shape)
      : grid_(grid), period_(std::move(shape.period)), warp_(shape.warp), sampled_(shape.sampled) {}

  const std::optional<GradedPeriod>& period() const { return period_; }
  const std::optional<Warp>& warp() const { return warp_; }
  const SampledMap* sampled() const { return sampled_.get(); }
  /// Whether all cells are alike.
  bool is_uniform() const { return !period_ && !is_mapped(); }
  bool is_mapped() const { return warp_ || sampled_; }
  /// Whether the cells fill the place of a point.
  bool holds(Vec3 p) const {
    return warp_ ? warp_->is_in_shell(warp_->radius(p)) : !sampled_ || sampled_->is_in_box(p);
  }
  /// What mapped cells fill; null of others.
  std::unique_ptr<const CellShell> shell() const;
  /// The coordinate of a point along the period's axis.
  double position(Vec3 p) const { return grid_.to_grid(p)[period_->axis()]; }

  /// The position in the cell, 0 to 1, and the angles: the definition.
  Vec3 fraction(Vec3 p) const;
  Vec3 at(Vec3 p) const { return angles_of(fraction(p)); }
  /// The same for many points, to the last bit. x, y, z and the angles are `count` values; uniform
  /// coordinates are allowed.
  void find(Values x, Values y, Values z, size_t count, double* const (&angles)[3]) const;
  CellIndex cell_of(Vec3 p) const;

  /// The gradient in the model's frame of a function with this gradient by angles.
  Vec3 gradient(Vec3 p, Vec3 by_angle) const;
  /// Bound on the rounding of the number of cells, in addition to that of the position, for points
  /// within that distance of p. Not for warped cells and maps (their slack()).
  double error(Vec3 p, double distance) const;

 private:
  Neighbourhood grid_;
  std::optional<GradedPeriod> period_;
  std::optional<Warp> warp_;
  std::shared_ptr<const SampledMap> sampled_;
};

}  // namespace msq
