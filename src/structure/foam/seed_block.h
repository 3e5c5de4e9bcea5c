// SPDX-License-Identifier: Apache-2.0
// The seeds of a brick of cells and of all cells around it that can matter to its seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/seeds.h"

namespace msq {

class SeedBlock {
 public:
  /// The brick of side^3 cells whose first is `corner`. Seeds farther from a seed than twice the
  /// empty radius do not meet its Voronoi cell; the block reaches that far.
  SeedBlock(const FoamSeeds& seeds, CellIndex corner, int side);

  /// Of a cell of the brick (0 to side - 1 along each axis); ascends with z, then y, then x.
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z + halo_[2]) * size_[1] + static_cast<size_t>(y + halo_[1])) *
               size_[0] +
           static_cast<size_t>(x + halo_[0]);
  }
  /// Foam units, from the corner of the brick's first cell.
  Vec3 position(size_t index) const { return positions_[index]; }

  /// Indices, ascending, of the seeds within about sqrt(distance_squared) of a brick's seed, itself
  /// left out: all that are, and some that are farther by up to 1e-4. `found` has room for all.
  size_t near(size_t own, double distance_squared, std::vector<uint32_t>& found) const;

 private:
  struct Row {
    ptrdiff_t start;       // from the own seed's index
    double least_squared;  // distance, in y and z, that its seeds have at least
  };

  int halo_[3];
  size_t size_[3];
  std::vector<Vec3> positions_;
  std::vector<float> x_, y_, z_;  // the same in single precision, padded by a vector
  std::vector<Row> rows_;
};

}  // namespace msq
