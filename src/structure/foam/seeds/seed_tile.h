// SPDX-License-Identifier: Apache-2.0
// The seeds of a box of cells and of the cells around it, computed in vectors of seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq {

class SeedTile {
 public:
  /// The box of size[0] x size[1] x size[2] cells whose first is `low`, and `halo` cells on either
  /// side of it.
  void build(const FoamSeeds& seeds, CellIndex low, const int (&size)[3], const int (&halo)[3]);

  /// The number of those seeds; also valid for numbers that exceed memory.
  static double seeds(const int (&size)[3], const int (&halo)[3]) {
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) count *= double(size[axis]) + 2 * halo[axis];
    return count;
  }

  /// The index of a cell of the box. The index of a cell (dx, dy, dz) away in the tile is index +
  /// offset(dx, dy, dz).
  size_t index(CellIndex cell) const {
    return static_cast<size_t>(offset(cell.x - first_.x, cell.y - first_.y, cell.z - first_.z));
  }
  ptrdiff_t offset(int dx, int dy, int dz) const {
    return (ptrdiff_t{dz} * length_[1] + dy) * length_[0] + dx;
  }

  /// A seed's coordinate from the corner of its own cell, in cell sizes: a multiple of 2^-21 in [0,
  /// 1), which single precision holds exactly. A few more values past the last may be read.
  const float* fraction(int axis) const { return fraction_[axis].data(); }

 private:
  CellIndex first_;  // with the halo
  int length_[3] = {0, 0, 0};
  std::vector<float> fraction_[3];
};

}  // namespace msq
