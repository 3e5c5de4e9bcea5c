// SPDX-License-Identifier: Apache-2.0
// Seeds by name, near a point: of foams with one seed per cell and of graded ones.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/borrowed.h"
#include "base/id_hash.h"
#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seed_trees.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

/// A seed of a foam. Its name is its cell and its leaf there, which is 0 in a cell with one seed.
struct NamedSeed {
  CellIndex cell;
  uint32_t leaf;    ///< of GradedSeedName, order << 3 | level: ascends in the order of leaves
  Vec3 in_cell;     ///< position in the cell, whose box has size 1
  double lift = 0;  ///< of seeds with weights (seeds/seeds.h)

  /// By cell (z, then y, then x), then by leaf: the order of seeds.
  friend bool operator<(const NamedSeed& a, const NamedSeed& b) {
    if (a.cell.z != b.cell.z) return a.cell.z < b.cell.z;
    if (a.cell.y != b.cell.y) return a.cell.y < b.cell.y;
    if (a.cell.x != b.cell.x) return a.cell.x < b.cell.x;
    return a.leaf < b.leaf;
  }
  friend bool operator==(const NamedSeed& a, const NamedSeed& b) {
    return a.cell == b.cell && a.leaf == b.leaf;
  }
  void add_name(IdHash& hash) const {
    hash.add(static_cast<uint32_t>(cell.x) | uint64_t{static_cast<uint32_t>(cell.y)} << 32);
    hash.add(static_cast<uint32_t>(cell.z) | uint64_t{leaf} << 32);
  }
  /// In foam units from the corner of a cell.
  Vec3 from(CellIndex home, Vec3 scale) const {
    return Vec3{cell.x - home.x + in_cell.x, cell.y - home.y + in_cell.y,
                cell.z - home.z + in_cell.z} *
           scale;
  }
};

class NamedSeeds {
 public:
  /// The seeds about the brick of side^3 cells whose first is `corner`. `graded`: null if there is
  /// one seed in each cell.
  void move_to(const FoamSeeds& seeds, const std::shared_ptr<const GradedSeeds>& graded,
               CellIndex corner, int side);

  /// Fills `near`, in the order of seeds, with all seeds that are farther from p than its nearest
  /// one by at most `more`; distances are lifted (seeds/seeds.h). p, in foam units from the brick's
  /// corner, is within 1.001 times the empty radius of a seed of the brick.
  void find(Vec3 p, double more, std::vector<NamedSeed>& near);

  Vec3 scale() const { return scale_; }
  /// Of the foam (seeds/seeds.h).
  double empty_radius() const { return empty_radius_; }
  CellIndex corner() const { return corner_; }
  size_t bytes() const {
    return in_cell_.capacity() * sizeof(Vec3) + lifts_.capacity() * sizeof(double) +
           found_.capacity() * sizeof(Found) + trees_.bytes();
  }

 private:
  struct Found {
    double squared;
    int cell[3];
  };

  void find_graded(Vec3 p, double more, std::vector<NamedSeed>& near);
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z + halo_[2]) * size_[1] + static_cast<size_t>(y + halo_[1])) *
               size_[0] +
           static_cast<size_t>(x + halo_[0]);
  }
  const Vec3& in_cell(int x, int y, int z) const { return in_cell_[index(x, y, z)]; }
  double lift(int x, int y, int z) const { return lifts_.empty() ? 0 : lifts_[index(x, y, z)]; }

  // Of the foam of the last move_to(). Threads keep this object, and must not keep the foam's.
  const GradedSeeds* graded_ = nullptr;
  CellIndex corner_;
  Vec3 scale_;
  double empty_radius_ = 0;
  int halo_[3] = {0, 0, 0};
  size_t size_[3] = {0, 0, 0};
  std::vector<Vec3> in_cell_;
  std::vector<double> lifts_;  // with a weight only
  std::vector<Found> found_;
  SeedTrees trees_;
};

}  // namespace msq
