// SPDX-License-Identifier: Apache-2.0
// Cells whose size varies along one axis of the grid.
#pragma once

#include "cell/graded_period.h"
#include "structure/lattice/warped/cell_places.h"

namespace msq {

class GradedPlaces final : public CellPlaces {
 public:
  GradedPlaces(const Neighbourhood& grid, GradedPeriod period);

  const Neighbourhood& smallest() const override { return smallest_; }
  double largest() const override;
  bool is_alike_from_origin() const override { return true; }
  CellIndex cell_of(Vec3 g) const override;
  Vec3 place(CellIndex cell, Vec3 fraction) const override;
  Box3 bounds(const CellBlock& cells) const override;
  void for_each_block(const Box3& box, const TakeBlock& take) const override;
  void describe(HashInput& input) const override { period_.describe(input); }

 private:
  Neighbourhood smallest_;
  GradedPeriod period_;
};

}  // namespace msq
