// SPDX-License-Identifier: Apache-2.0
// The seeds around one cell. They are computed as far out as the cell's points need, and kept for
// the next point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq {

/// How far each cell of a block lies from the middle one, as numbers and, along x, as an integer
/// that wraps.
struct CellSteps {
  std::vector<double> x, y, z;
  std::vector<uint64_t> step_x;
};

class CellSeeds {
 public:
  /// Moves to the seeds around a cell; free if these are the current ones.
  void move_to(const FoamSeeds& seeds, CellIndex cell);

  /// Seeds in the order of their cells (z, then y, then x), foam units from the cell's corner.
  struct Block {
    int half[3] = {};             // cells on either side
    CellSteps cells;              // of each seed
    std::vector<double> x, y, z;  // padded by a vector of seeds at infinity
    std::vector<double> lift;     // with a weight only
    size_t count = 0;

    Vec3 position(uint32_t i) const { return {x[i], y[i], z[i]}; }
    LiftedSeed lifted(uint32_t i) const { return {position(i), lift[i]}; }
    /// Distance from a point of the cell up to which the block contains all seeds.
    double reach(Vec3 q, Vec3 scale) const;
  };
  /// Fills `found` with the seeds within nearest distance + 2 radius + near_slack (seeds.h) of a
  /// point of the cell; distances are lifted ones, which are no less than those that reach()
  /// bounds. Their numbers are those of the returned block, which is valid until the next call.
  const Block& find_near(Vec3 q, double radius, std::vector<uint32_t>& found);

  /// Approximate memory, which decides whether this is kept or deleted (base/borrowed.h).
  size_t bytes() const { return 13 * sizeof(double) * distance_squared_.capacity(); }

 private:
  /// Gives a block that extends at least `step` + 1 foam units its cells.
  void plan(Block& block, size_t step) const;
  /// The block that extends at least `step` + 1 foam units beyond the cell.
  const Block& block(size_t step);
  /// Computes the squared distances of a block's seeds; returns the minimum.
  double find_distances(const Block& block, Vec3 q);
  void find_lifts(Block& block) const;

  std::vector<double> distance_squared_;
  std::vector<uint64_t> keys_;  // of each seed's row
  std::optional<FoamSeeds> seeds_;
  CellIndex cell_;
  std::vector<Block> blocks_;
  size_t known_ = 0;  // number of blocks that hold the seeds of cell_
};

}  // namespace msq
