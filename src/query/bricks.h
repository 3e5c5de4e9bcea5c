// SPDX-License-Identifier: Apache-2.0
// A box of equal cells divided into bricks of cells, so that points of a brick lie close together.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/vec.h"

namespace msq {

class Bricks {
 public:
  using Counts = std::array<uint64_t, 3>;

  /// Bricks of at most `most` cells (at least one), with sides as equal in length as the cells'
  /// size allows.
  Bricks(const Counts& counts, Vec3 cell_size, uint64_t most) : counts_(counts) {
    while (2 * brick_[0] * brick_[1] * brick_[2] <= most) {
      int shortest = -1;
      for (int axis = 0; axis < 3; ++axis) {
        if (brick_[at(axis)] >= counts_[at(axis)]) continue;
        if (shortest < 0 || length(cell_size, axis) < length(cell_size, shortest)) shortest = axis;
      }
      if (shortest < 0) break;
      brick_[at(shortest)] *= 2;
    }
    for (size_t axis = 0; axis < 3; ++axis)
      bricks_[axis] = counts_[axis] / brick_[axis] + (counts_[axis] % brick_[axis] != 0);
  }

  uint64_t count() const { return bricks_[0] * bricks_[1] * bricks_[2]; }

  /// Calls visit(i, j, k) for the cells of a brick, x first.
  template <class Visit>
  void for_each_cell(uint64_t brick, Visit&& visit) const {
    const Counts place{brick % bricks_[0], brick / bricks_[0] % bricks_[1],
                       brick / bricks_[0] / bricks_[1]};
    Counts first, last;
    for (size_t axis = 0; axis < 3; ++axis) {
      first[axis] = place[axis] * brick_[axis];
      last[axis] = std::min(counts_[axis], first[axis] + brick_[axis]);
    }
    for (uint64_t k = first[2]; k < last[2]; ++k)
      for (uint64_t j = first[1]; j < last[1]; ++j)
        for (uint64_t i = first[0]; i < last[0]; ++i) visit(i, j, k);
  }

 private:
  static size_t at(int axis) { return static_cast<size_t>(axis); }
  double length(Vec3 cell_size, int axis) const {
    return static_cast<double>(brick_[at(axis)]) * cell_size[axis];
  }

  Counts counts_, brick_{1, 1, 1}, bricks_;
};

}  // namespace msq
