// SPDX-License-Identifier: Apache-2.0
// For each cell the struts of a foam that a ray may meet in it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeded_edges.h"
#include "strut/capsule_rays.h"

namespace msq {

/// Seeds about a cell as small numbers, which ascend in the order of seeds.
class NearCells {
 public:
  /// For the seeds of edges that come within `reach` (foam units) of the middle of a cell.
  NearCells(const FoamSeeds& seeds, double reach);

  /// Whether there are few enough for numbers of 10 bits.
  bool fits() const { return cells_.size() <= 1024; }
  /// Of a cell that lies (x, y, z) from the one in the middle.
  uint32_t number(int x, int y, int z) const {
    return static_cast<uint32_t>(
        ((z + half_[2]) * (2 * half_[1] + 1) + y + half_[1]) * (2 * half_[0] + 1) + x + half_[0]);
  }
  CellIndex at(CellIndex middle, uint32_t number) const {
    const auto& d = cells_[number];
    return {middle.x + d[0], middle.y + d[1], middle.z + d[2]};
  }

 private:
  int half_[3];
  std::vector<std::array<int8_t, 3>> cells_;
};

/// The lists of a few cells.
class RayCells final : public CellData {
 public:
  /// Cells along each axis.
  static constexpr int side = 2;
  /// How far from the middle of a cell the axes of its list's struts may be.
  static double reach(const FoamSeeds& seeds, double radius);

  using Fetch = std::function<const SeededEdges&(CellIndex corner)>;
  /// The lists of struts of a radius (foam units) for the side^3 cells from `corner` on.
  /// fetch(corner) returns the edges of a brick, which live until the next call.
  RayCells(const FoamSeeds& seeds, const NearCells& near, double radius, CellIndex corner,
           const Fetch& fetch);

  /// The list of a cell, by its place in the brick; foam units, from the cell's corner.
  CapsuleView list(int x, int y, int z) const {
    const size_t cell = static_cast<size_t>((z * side + y) * side + x), start = starts_[cell];
    CapsuleView view;
    for (size_t axis = 0; axis < 3; ++axis) {
      view.a[axis] = values_.data() + axis * stride_ + start;
      view.ab[axis] = values_.data() + (axis + 3) * stride_ + start;
    }
    view.count = starts_[cell + 1] - start;
    return view;
  }
  /// The three seeds of each strut of it, ten bits each, in the order of seeds; `unknown` where
  /// they are not known.
  const uint32_t* seeds(int x, int y, int z) const {
    return seeds_.data() + starts_[static_cast<size_t>((z * side + y) * side + x)];
  }
  static constexpr uint32_t unknown = UINT32_MAX;

  uint64_t bytes() const override {
    return sizeof *this + values_.capacity() * sizeof(float) + seeds_.capacity() * sizeof(uint32_t);
  }

 private:
  size_t stride_ = 0;
  uint32_t starts_[side * side * side + 1];
  std::vector<float> values_;
  std::vector<uint32_t> seeds_;
};

}  // namespace msq
