// SPDX-License-Identifier: Apache-2.0
// The cells of a power diagram (seeds/seeds.h) of the seeds of a brick, one after another.
//
// From a seed, the plane of equal power with another one at d is d . x = (|d|^2 + l) / 2, l being
// its lift less the own one. With V the distance of a cell's farthest vertex, planes farther than V
// cut nothing. That of a seed beyond D is at least (D - lift / D) / 2 away, lift being the own one,
// and so beyond V if D >= V + sqrt(V^2 + lift).
//
// Most seeds lie inside their cells. Then a walk (voronoi_cell.h) among the planes not farther than
// some guess of V finds the cell; it is the true one if V is not more. A seed may lie outside its
// cell, and may have none; walks may fail, as in brick_cells.h. Then the cell is cut from a cube
// plane by plane (clipped_cell.h): first by the seeds within some D, in ascending order of the
// distances of their planes, then, until D is enough for V, by those farther away.
#pragma once

#include <vector>

#include "structure/foam/edges/brick_seeds.h"
#include "structure/foam/edges/clipped_cell.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class WeightedCells {
 public:
  struct Neighbour {
    Vec3 position;  ///< relative to the own seed
    double offset;  ///< of its plane: position . x = offset
    double plane;   ///< distance of that from the seed; below 0 where the seed is beyond it
    uint32_t seed;  ///< its number in block()
  };

  /// Goes to the brick of side^3 cells whose first is `corner`.
  void move_to(const FoamSeeds& seeds, CellIndex corner, int side);

  enum class Found {
    walked,  ///< walked(); its planes are those of seeds, in ascending order of number
    cell,    ///< clipped(); its planes are those of neighbours()
    none,    ///< the seed owns no cell
    unknown  ///< rounding defeats the cuts; neighbours() has all seeds that may matter
  };
  Found find(size_t own);

  const BrickSeeds& block() const { return block_; }
  const VoronoiCell& walked() const { return walked_; }
  /// Of walked(): how many of its planes belong to seeds before the own one.
  uint32_t before() const { return before_; }
  const ClippedCell& clipped() const { return clipped_; }
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }
  double lift(size_t seed) const { return lifts_[seed]; }
  /// Greatest distance of a point of a cell from its seed.
  double empty_radius() const { return empty_radius_; }

  /// Approximate memory.
  size_t bytes() const {
    return sizeof *this + block_.bytes() + lifts_.capacity() * sizeof(double);
  }

 private:
  bool walk(size_t own);
  /// Leaves the planes of walked() that are not farther than `reach`, and sets their offsets.
  /// Returns false if the seed is not inside its cell.
  bool keep_planes(size_t own, double reach);
  Found cut(size_t own);
  /// Appends the neighbours farther than sqrt(from) up to sqrt(to), by their planes.
  void append(size_t own, double from, double to);
  void take(size_t own, uint32_t seed, double from, double to);

  BrickSeeds block_;
  std::vector<double> lifts_;  // of the seeds of the block
  VoronoiCell walked_;
  uint32_t before_ = 0;
  ClippedCell clipped_;
  std::vector<Neighbour> neighbours_;
  double first_squared_ = 0;
  double typical_squared_ = 0;  // of V
  double weight_squared_ = 0;
  double empty_radius_ = 0;
  double max_squared_ = 0;  // twice that, squared
};

}  // namespace msq
