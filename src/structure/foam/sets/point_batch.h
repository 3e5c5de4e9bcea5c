// SPDX-License-Identifier: Apache-2.0
// The point query for many points of a cell. The results equal foam_point_inside(), bit for bit.
// The seeds around the cell are found once, and vectors of seeds and of points are evaluated.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "structure/foam/seeds/seed_tile.h"
#include "structure/foam/sets/point_kernels.h"

namespace msq {

class PointBatch {
 public:
  /// Finding the seeds of a whole box of cells at once is faster up to this number of seeds per
  /// point (docs/benchmarks.md); a single point needs 27 or more.
  static constexpr double max_seeds_a_point = 16;

  /// All radii are at most max_radius (foam units).
  PointBatch(const FoamSeeds& seeds, double max_radius);
  /// The array for the results, 0 or 1, by the points' indices.
  void answer_to(uint8_t* inside) { inside_ = inside; }

  /// Moves to the cells of a box of size[0] x size[1] x size[2] from `low` on. All following cells
  /// lie in it. This finds the seeds around them, so the box should contain few cells without
  /// points. If `is_sparse`, it is a single cell, and fewer seeds around it are found.
  void move_to(CellIndex low, const int (&size)[3], bool is_sparse = false);
  /// The number of seeds that this finds.
  double seeds_about(const int (&size)[3]) const { return SeedTile::seeds(size, second_.half); }

  /// Adds a point of the next cell: q in foam units from its corner.
  void add(Vec3 q, double radius, uint32_t index) {
    x_[count_] = q.x;
    y_[count_] = q.y;
    z_[count_] = q.z;
    radius_[count_] = radius;
    index_[count_] = index;
    ++count_;
  }
  bool is_full() const { return count_ == capacity; }
  /// Evaluates the points added; some results may not be ready before finish().
  void ask(CellIndex cell);
  void finish();

 private:
  static constexpr size_t capacity = PlacesView::most;

  /// The seeds of the cells up to half[axis] away from a point's cell.
  struct Block {
    int half[3];
    size_t seeds = 0, mask_words = 0;
    float slack = 0;                // of distances in single precision, foam units
    std::vector<Vec3> cell;         // of each seed, from the point's
    std::vector<ptrdiff_t> offset;  // of each seed in the tile
    std::vector<float> x, y, z;
  };
  void plan(Block& block, int step) const;
  /// Evaluates the first `count` of the points added with a block. Returns the number of points for
  /// which the block is too small; these are then the first.
  size_t ask(Block& block, CellIndex cell, size_t count);
  /// Adds a point that may lie inside, and the seeds that may decide it.
  void push(const Block& block, size_t home, size_t point, const uint64_t* mask, size_t count);
  void decide(size_t seeds);

  const FoamSeeds seeds_;
  uint8_t* inside_ = nullptr;
  Block first_, second_;
  bool has_first_, has_second_;  // small enough
  bool is_wide_ = false;         // the tile has room for the second
  SeedTile tile_;

  size_t count_ = 0;
  double x_[capacity] = {}, y_[capacity] = {}, z_[capacity] = {}, radius_[capacity] = {};
  uint32_t index_[capacity];
  std::vector<uint64_t> masks_;
  std::vector<Vec3> candidates_, near_;
  std::vector<double> distance_squared_;
  // By the number of seeds, from 3. Not a vector, which would clear them twice.
  std::unique_ptr<TripleBatch[]> triples_ =
      std::make_unique_for_overwrite<TripleBatch[]>(TripleBatch::max_seeds - 2);
};

}  // namespace msq
