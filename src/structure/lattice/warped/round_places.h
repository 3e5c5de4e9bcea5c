// SPDX-License-Identifier: Apache-2.0
// Cells around an axis or around a point. Those that have struts are whole: along x from 0 to as
// many as fit below the outer radius, around a point along z from pole to pole. Points elsewhere
// have cells too, which have none.
#pragma once

#include "cell/warp.h"
#include "structure/lattice/warped/cell_places.h"

namespace msq {

class RoundPlaces final : public CellPlaces {
 public:
  /// The most that a cell may span, seen from the axis or the point.
  static constexpr double max_angle = 150;  // degrees

  /// Throws Error(argument) if no whole cell fits between the radii, or cells, sheared, span more.
  explicit RoundPlaces(const Warp& warp);

  const Neighbourhood& smallest() const override { return smallest_; }
  double largest() const override { return largest_; }
  bool is_alike_from_origin() const override { return false; }
  CellIndex cell_of(Vec3 g) const override;
  CellIndex canonical(CellIndex cell) const override;
  CellIndex nearest_with_struts(CellIndex cell) const override;
  Ends ends(CellIndex cell) const override;
  Vec3 place(CellIndex cell, Vec3 fraction) const override;
  unsigned folded_axes(CellIndex cell, Vec3 fraction) const override;
  Box3 bounds(const CellBlock& cells) const override;
  void for_each_block(const Box3& box, const TakeBlock& take) const override;
  void describe(HashInput& input) const override;

 private:
  bool is_spherical() const { return warp_.kind() == Warp::Kind::spherical; }
  /// What the shear adds to v in some cells.
  Interval shear(const CellBlock& cells) const;

  Warp warp_;      // in grid coordinates
  Warp straight_;  // the same without a shear
  Neighbourhood smallest_;
  double largest_;
  double layers_;  // of cells outwards; may be infinite
  double dip_;  // the distance of a strut from the middle is at least this times that of its ends
};

}  // namespace msq
