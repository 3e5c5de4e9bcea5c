// SPDX-License-Identifier: Apache-2.0
// The seeds around one cell, found as far out as its points ask for and kept for the next point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "structure/foam/seeds.h"

namespace msq {

class CellSeeds {
 public:
  /// Turns to the seeds around a cell; free if they are those at hand.
  void move_to(const FoamSeeds& seeds, CellIndex cell);

  /// Seeds in the order of their cells (z, then y, then x), foam units from the cell's corner.
  struct Block {
    int half[3];                  // cells on either side
    std::vector<double> x, y, z;  // padded by a vector of seeds at infinity
    size_t count = 0;

    Vec3 position(uint32_t i) const { return {x[i], y[i], z[i]}; }
    /// How far around a point of the cell the block reaches.
    double reach(Vec3 q, Vec3 scale) const;
  };
  /// Fills `found` with the seeds within nearest distance + 2 radius + near_slack (point.h) of a
  /// point of the cell, numbered as in the block returned, which lives until the next call.
  const Block& find_near(Vec3 q, double radius, std::vector<uint32_t>& found);

 private:
  /// The block that reaches at least `step` + 1 foam units out of the cell.
  const Block& block(size_t step);
  /// Finds the squared distances of a block's seeds; returns the least.
  double find_distances(const Block& block, Vec3 q);

  std::vector<double> distance_squared_;
  std::optional<FoamSeeds> seeds_;
  CellIndex cell_;
  std::vector<Block> blocks_;
  size_t known_ = 0;  // blocks that hold the seeds of cell_
};

}  // namespace msq
