// SPDX-License-Identifier: Apache-2.0
// The seeds of a brick of cells and of all cells around it that can matter to its seeds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/edges/voronoi_cell.h"
#include "structure/foam/seeds/seed_tile.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class BrickSeeds {
 public:
  /// Moves to the brick of side^3 cells whose first is `corner`. Seeds farther from a seed than
  /// twice the empty radius do not touch its Voronoi cell; the block reaches that far. Queries of
  /// distances up to sqrt(max_often) are faster.
  void move_to(const FoamSeeds& seeds, CellIndex corner, int side, double max_often);

  int side() const { return side_; }
  /// Index of a cell of the brick (0 to side - 1 along each axis); ascends with z, then y, then x.
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z + halo_[2]) * size_[1] + static_cast<size_t>(y + halo_[1])) *
               size_[0] +
           static_cast<size_t>(x + halo_[0]);
  }
  /// The cell of a seed, relative to the brick's first cell.
  const std::array<int, 3>& cell(size_t index) const { return cells_[index]; }
  /// Foam units, from the corner of the brick's first cell.
  Vec3 position(size_t index) const { return positions_[index]; }

  const std::vector<Vec3>& positions() const { return positions_; }

  size_t bytes() const {
    return positions_.capacity() * (sizeof(Vec3) + sizeof cells_[0] + 6 * sizeof(float)) +
           (near_.x.capacity() + all_.x.capacity()) * 5 * sizeof(float);
  }

  /// Refills a cell with the planes to the seeds within sqrt(distance_squared) of a brick's seed,
  /// except that seed itself, in ascending order of index. Includes all of them, and some that are
  /// farther by up to 1e-4. Stops if there are more than max_planes. Returns how many come before
  /// the seed itself.
  size_t refill(VoronoiCell& cell, size_t own, double distance_squared) const;

  /// The seeds near a seed, in runs of `lanes` consecutive seeds along x. For each lane: the index
  /// relative to the own seed's, and the corner of the cell relative to that of the own cell. Lanes
  /// without a seed, and the own seed's lane, are far away.
  struct Stretches {
    static constexpr size_t lanes = 8;
    std::vector<ptrdiff_t> starts;
    std::vector<int32_t> seed;
    std::vector<float> x, y, z;
  };
  /// Positions within their cells.
  struct Fractions {
    std::vector<float> x, y, z;
  };

 private:
  Stretches stretches(Vec3 scale, double distance_squared) const;

  void plan(Vec3 scale, double reach, int side, double max_often);

  int side_ = 0;  // 0: nothing is prepared
  Vec3 scale_;
  int halo_[3];
  size_t size_[3];
  std::vector<std::array<int, 3>> cells_;
  SeedTile tile_;
  std::vector<Vec3> positions_;
  Fractions fractions_;
  double max_often_ = 0;
  Stretches near_, all_;
};

}  // namespace msq
