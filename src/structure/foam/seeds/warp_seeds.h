// SPDX-License-Identifier: Apache-2.0
// Seeds in cells around an axis or a point (cell/warp.h): that of a cell (i, j, k) and a position f
// in it lies where the map has the coordinates (i, j, k) + f. Cells go around the axis, so j is
// counted modulo the count of cells there.
//
// The shell. The foam is needed between the inner and the outer radius of the warp. There its
// diagram is that of the cells of all rings: inwards to the axis, outwards without end. A ring
// whose inner face has a negative radius goes on through the axis, to the other side. Around a
// point, rings are shells, and what is said of the axis holds of the point.
//
// Not all rings have seeds. Outwards, rings would become ever wider, inwards ever narrower. So
// there are as many beyond the shell as decide the diagram in it, and farther out there is one seed
// in each box that rings do not fill. Let `reach` be the most that a strut or a wall reaches, and
// d(r) bound the distance of points up to a radius r from the seeds of their cells. A point v
// within `reach` of the shell, at the radius r, has its nearest seeds within d(r), so seeds that
// are farther from it do not change the diagram there. Seeds of boxes are farther out than
// outer + reach + d(outer + reach), so farther from v than that. Inwards the same holds: those are
// below inner - x, so r - inner + x from v, and r - d(r) is least at one of the two ends, as d is
// convex.
//
// Boxes are cubes, or higher or lower, and exceed the largest cells of rings by `room`. The squared
// distance of points at radii r and s, t apart in angle, is (r - s)^2 + 2 r s (1 - cos t). This is
// at most (r - s)^2 + (max(r, s) t)^2 for radii of one sign, and (r - s)^2 for others. Around a
// point, the chord of t is at most the root of the sum of the squares of the differences of
// latitude and longitude. In sheared cells, points of a cell are up to 1 + |shear_outwards| +
// |shear_along| widths apart around the axis. So a point of a ring is no farther from the seed of
// its cell than the diagonal of a box of the cell's sizes, where it is widest, its width times that
// sum; and elsewhere each box has a seed. So the diagonal of a box bounds the distance of any point
// to its nearest seed. Places are off by 2^-40 boxes and by 2^-46 of the distance from the origin,
// which is below 2^24 cells: far less than `room`.
#pragma once

#include "cell/context.h"
#include "cell/warp.h"
#include "structure/foam/seeds/placed_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class WarpSeeds final : public PlacedSeeds {
 public:
  /// By how much the largest size of a cell in the shell may exceed the smallest.
  static constexpr double max_ratio = 16;
  /// Of cells, of which a box may have the seeds.
  static constexpr double max_in_box = 32766;

  /// Throws Error(argument) for a shell without an outer radius, and Error(limit) for ratios above
  /// max_ratio, too few cells around a point, or where a box would have too many cells.
  WarpSeeds(Ref<Context> context, const Warp& warp, double jitter, uint64_t seed);
  ~WarpSeeds() override;

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
  double max_density() const override;
  bool is_needed(const Box3& box) const override;
  void describe(HashInput& input) const override;

  /// The rings that have seeds. Of i, in the order of cells outwards.
  int32_t first_ring() const { return first_; }
  int32_t last_ring() const { return last_; }

 private:
  static constexpr double room = 0x1p-14;

  /// Cells of which a box may have seeds, and perhaps others: counts along each axis, from the
  /// first. Around the axis modulo the count.
  struct Block {
    CellIndex first;
    int32_t count[3];

    int32_t cells() const { return count[0] * count[1] * count[2]; }
  };
  Block block_of(CellIndex box) const;
  CellIndex cell_in(const Block& block, uint32_t number) const;
  /// The smallest and the greatest distance from the axis or the point in a box, in grid
  /// coordinates.
  Interval radii_of(const Box3& box) const;
  Box3 bounds_of(CellIndex box) const;
  /// Whether rings do not fill the box, so that it has a seed of its own.
  bool has_own(CellIndex box) const;
  /// That seed; its number is 0.
  PlacedSeed own_seed(CellIndex box) const;
  /// The seed of a cell, without its number.
  PlacedSeed place(CellIndex cell) const;
  /// Appends those of the block's cells that are in the box.
  void place_all(CellIndex box, const Block& block, std::vector<PlacedSeed>& seeds) const;
  CellIndex canonical(CellIndex cell) const;
  /// Around the axis, and along it or from south to north.
  double width(double radius) const;
  double height(double radius) const;
  /// Bounds the distance of points up to a radius from the seeds of their cells.
  double diagonal(double radius) const;
  double box_volume() const;

  const Ref<Context> context_;
  const uint64_t id_;              // in the cache
  Warp warp_;                      // in grid coordinates
  Neighbourhood grid_, smallest_;  // of boxes
  bool is_round_;                  // around a point
  double swell_;                   // widths that points of a cell are apart at most, by the shear
  double largest_ = 0, reach_ = 0;
  FoamSeeds cells_;  // in cells of size 1
  FoamSeeds own_;    // of boxes that rings do not fill
  int32_t first_ = 0, last_ = 0;
  double low_ = 0, high_ = 0;  // radii between which rings fill everything
};

}  // namespace msq
