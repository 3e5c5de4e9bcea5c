// SPDX-License-Identifier: Apache-2.0
// Seeds in the cells of a sampled map (cell/sampled_map.h): that of a cell (i, j, k) and a position
// f in it lies where the map has the coordinates (i, j, k) + f. A cell has no seed if that place is
// not in the box of the samples.
//
// Boxes are cubes. Their side is twice the longest edge of a cell, in the middle of any voxel, and
// then times 9/8 until each box inside the box of the samples, except those along its faces, has a
// seed. Each other box without one has a seed of its own: so the foam goes on beyond the samples,
// and the diagonal of a box bounds the distance of any point to its nearest seed. That holds
// whatever the map is, also where it has the same coordinates at two places.
//
// All seeds are found at once and kept, since a place is found by a search among the samples. Each
// box knows a bound on the distances of its points to their nearest seeds: of each 64th of the box,
// the distance from its middle to a seed and half of its diagonal.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/memory.h"
#include "cell/context.h"
#include "cell/sampled_map.h"
#include "structure/foam/seeds/placed_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class SampledSeeds final : public PlacedSeeds {
 public:
  /// By how much the longest edge of a cell may exceed the smallest size.
  static constexpr double max_ratio = 16;
  static constexpr double max_cells = 0x1p24;
  static constexpr double max_boxes = 0x1p24;
  /// Of seeds in a box.
  static constexpr uint32_t max_in_box = 32766;

  /// Throws Error(limit) for a ratio above max_ratio, too many cells or boxes, too many seeds in a
  /// box, or too little memory. Error(cancelled) with the thread's job.
  SampledSeeds(const Context& context, std::shared_ptr<const SampledMap> map, double jitter,
               uint64_t seed);

  const Neighbourhood& grid() const override { return grid_; }
  const Neighbourhood& smallest() const override { return smallest_; }
  double largest() const override { return map_->longest_edge(); }
  void find(CellIndex box, std::vector<PlacedSeed>& seeds) const override;
  PlacedSeed seed(CellIndex box, uint32_t number) const override;
  CellIndex cell_of(CellIndex box, uint32_t number) const override;
  PlacedSeed near(Vec3 g) const override;
  CellIndex cell_of(Vec3 g) const override;
  double max_distance(const Box3& box) const override;
  Interval density(const Box3& box) const override;
  double max_density() const override { return most_in_box_; }
  bool is_needed(const Box3& box) const override;
  void describe(HashInput& input) const override;

 private:
  /// A cell and its place, in the frame of the samples.
  struct Found {
    Vec3 g;
    CellIndex cell;
  };
  struct Kept {
    Vec3 in_box;
    CellIndex cell;
    int level;
  };
  struct Boxes {
    CellIndex low, high;  // inclusive
  };

  std::vector<Found> find_all(const SampledMap::Cells& cells, const Executor& executor) const;
  /// Throws Error(limit) for too many.
  void set_side(double side);
  void choose_side(const std::vector<Found>& found);
  void keep(const std::vector<Found>& found, const Context& context);
  float bound_of(CellIndex box, std::vector<PlacedSeed>& seeds) const;
  int level_at(Vec3 g) const;

  double side() const { return grid_.cell_size.x; }
  CellIndex box_at(Vec3 g) const;
  /// In the table of boxes. Others have no seeds of cells.
  bool is_known(CellIndex box) const;
  size_t index(CellIndex box) const;
  PlacedSeed own_seed(CellIndex box) const;
  /// The seeds of cells in a box.
  std::span<const Kept> kept_in(CellIndex box) const;
  /// Those that a box in grid coordinates overlaps, if they are known and not too many.
  bool known_boxes(const Box3& box, Boxes& boxes) const;

  const std::shared_ptr<const SampledMap> map_;
  Neighbourhood grid_, smallest_;
  const FoamSeeds cells_;  // in cells of size 1
  const FoamSeeds own_;    // of boxes that have no other
  int32_t count_[3] = {};  // of boxes in the table
  Reservation reservation_;
  std::vector<uint32_t> first_;  // of each box, in `kept_`; one more
  std::vector<Kept> kept_;
  std::vector<float> bounds_;  // of each box, in its sides
  double most_in_box_ = 1;
};

}  // namespace msq
