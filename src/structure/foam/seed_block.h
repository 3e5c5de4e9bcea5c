// SPDX-License-Identifier: Apache-2.0
// The seeds of a brick of cells and of all cells around it that can matter to its seeds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/seed_tile.h"
#include "structure/foam/seeds.h"
#include "structure/foam/voronoi_cell.h"

namespace msq {

class SeedBlock {
 public:
  /// Turns to the brick of side^3 cells whose first is `corner`. Seeds farther from a seed than
  /// twice the empty radius do not meet its Voronoi cell; the block reaches that far. Distances up
  /// to sqrt(most_often) are looked up in less time.
  void move_to(const FoamSeeds& seeds, CellIndex corner, int side, double most_often);

  int side() const { return side_; }
  /// Of a cell of the brick (0 to side - 1 along each axis); ascends with z, then y, then x.
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z + halo_[2]) * size_[1] + static_cast<size_t>(y + halo_[1])) *
               size_[0] +
           static_cast<size_t>(x + halo_[0]);
  }
  /// The cell of a seed, from the brick's first cell.
  const std::array<int, 3>& cell(size_t index) const { return cells_[index]; }
  /// Foam units, from the corner of the brick's first cell.
  Vec3 position(size_t index) const { return positions_[index]; }

  const std::vector<Vec3>& positions() const { return positions_; }

  /// Refills a cell with the planes to the seeds within sqrt(distance_squared) of a brick's seed,
  /// itself left out, ascending by index: all that are, and some that are farther by up to 1e-4.
  /// Stops beyond most_planes of them. Returns how many come before the seed itself.
  size_t refill(VoronoiCell& cell, size_t own, double distance_squared) const;

  /// Seeds near another, in stretches of `lanes` that follow one another along x. Per lane: index
  /// from the own seed's, and corner of the cell from that of the own; far away for lanes without
  /// a seed and for the own.
  struct Stretches {
    static constexpr size_t lanes = 8;
    std::vector<ptrdiff_t> starts;
    std::vector<int32_t> seed;
    std::vector<float> x, y, z;
  };
  /// Positions in their cells.
  struct Fractions {
    std::vector<float> x, y, z;
  };

 private:
  Stretches stretches(Vec3 scale, double distance_squared) const;

  int side_ = 0;
  Vec3 scale_;
  int halo_[3];
  size_t size_[3];
  std::vector<std::array<int, 3>> cells_;
  SeedTile tile_;
  std::vector<Vec3> positions_;
  Fractions fractions_;
  double most_often_ = 0;
  Stretches near_, all_;
};

}  // namespace msq
