// SPDX-License-Identifier: Apache-2.0
// Seeds in cells whose size varies along one axis of the grid: that of a cell (i, j, k) and a
// position f in it lies, along the axis, at the s with w(s) = i + f (cell/graded_period.h), and
// along the other axes at (i + f) times the cell size.
//
// Boxes have the size of the cells along the other axes, and along the axis `room` more than the
// largest cell.
//
// Distances. Let n be the most cells of a knot, u the number of cells of a point, both below 2^29.
// The place of a seed is off by at most 2^-49 (n + |u|) largest cells (graded_period.h), which is
// 2^-19, and by 2^-23 boxes for the rounding of its place to the grid. So along the axis a point is
// no farther from the seed of its cell than that cell is long, and 2^-18 boxes. That is less than
// the length of a box, as `room` is 2^-14; along the other axes it is at most the cell size. So the
// diagonal of a box bounds the distance of any point to its nearest seed, and in a box of space
// that of the longest cell there, and 2^-18 boxes.
#pragma once

#include "cell/graded_period.h"
#include "structure/foam/seeds/placed_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class PeriodSeeds final : public PlacedSeeds {
 public:
  /// By how much the largest cell may exceed the smallest along the axis.
  static constexpr double max_ratio = 16;

  /// The ratio of the period is at most max_ratio. Of the grid's cell size, that along the axis is
  /// not used.
  PeriodSeeds(const Neighbourhood& grid, GradedPeriod period, double jitter, uint64_t seed);

  const Neighbourhood& grid() const override { return grid_; }
  const Neighbourhood& smallest() const override { return smallest_; }
  double largest() const override { return largest_; }
  void find(CellIndex box, std::vector<PlacedSeed>& seeds) const override;
  PlacedSeed seed(CellIndex box, uint32_t number) const override;
  CellIndex cell_of(CellIndex box, uint32_t number) const override;
  PlacedSeed near(Vec3 g) const override;
  CellIndex cell_of(Vec3 g) const override;
  double max_distance(const Box3& box) const override;
  Interval density(const Box3& box) const override;
  double max_density() const override { return size() * period_.most(); }
  void describe(HashInput& input) const override { period_.describe(input); }

 private:
  static constexpr double room = 0x1p-14;

  /// Of a box, along the axis.
  double size() const { return grid_.cell_size[period_.axis()]; }
  /// Cells along the axis, of which a box may have seeds, and perhaps others.
  struct Range {
    int32_t first, last;
  };
  Range cells_of(int32_t box) const;
  /// The seed of a cell, without its number.
  PlacedSeed place(CellIndex cell) const;

  Neighbourhood grid_, smallest_;
  GradedPeriod period_;
  double largest_;
  FoamSeeds cells_;  // in cells of size 1
};

}  // namespace msq
