// SPDX-License-Identifier: Apache-2.0
// Seeds that a map places: the cells of the map, each with one jittered seed (seeds.h), vary in
// size or are bent. Source of the seeds: a point of the cell, in coordinates of cells, and the
// point of space that the map gives it.
//
// A grid of boxes sorts them. A box has any number of seeds, also none: those that lie in it. The
// boxes are so large that every point of the foam has a seed as near as the diagonal of a box. So
// what holds of the empty balls of one seed in each cell of a grid holds here of its boxes.
//
// A seed's place is a multiple of 2^-40 of its box, along each axis. That is its definition, so all
// paths start from the same bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/hash_input.h"
#include "base/interval.h"
#include "cell/neighbourhood.h"

namespace msq {

struct PlacedSeed {
  CellIndex box;
  Vec3 in_box;      ///< position in the box, whose sides are 1: in [0, 1)
  uint32_t number;  ///< of the seed among those of its box, in their order; below 2^15
  int level;        ///< seeds are about 2^-level boxes apart
};

/// The part of `boxes` beyond its floor, rounded as a seed's place is.
inline double place_in_box(double boxes) {
  // A tiny negative number of boxes is 1 above its floor once rounded.
  return std::min(std::floor((boxes - std::floor(boxes)) * 0x1p40), 0x1p40 - 1) * 0x1p-40;
}

/// The level of a seed: of the volume of a box over that of the seed's cell the nearest power of 8,
/// as factors, up to 8^5. of_cell: the latter volume times 2.828.
inline int seed_level(double of_box, double of_cell) {
  constexpr int max_level = 5;
  int level = 0;
  while (level < max_level && of_box > std::ldexp(of_cell, 3 * level)) ++level;
  return level;
}

/// Of the seeds that boxes have of their own, where cells have none: XOR the seed of the foam.
constexpr uint64_t border_stream = 0x626f72646572;  // the bytes "border"

class PlacedSeeds {
 public:
  virtual ~PlacedSeeds() = default;

  /// The boxes.
  virtual const Neighbourhood& grid() const = 0;
  /// The grid of the smallest cells of the map, and the size of the largest.
  virtual const Neighbourhood& smallest() const = 0;
  virtual double largest() const = 0;

  /// Appends the seeds in a box, in their order.
  virtual void find(CellIndex box, std::vector<PlacedSeed>& seeds) const = 0;
  /// The seed of a box that has this number.
  virtual PlacedSeed seed(CellIndex box, uint32_t number) const = 0;
  /// The map's cell of that seed.
  virtual CellIndex cell_of(CellIndex box, uint32_t number) const = 0;
  /// A seed near a point of the foam, in grid coordinates.
  virtual PlacedSeed near(Vec3 g) const = 0;
  /// The map's cell that holds a point, in grid coordinates.
  virtual CellIndex cell_of(Vec3 g) const = 0;

  /// Bounds the distance of the points of a box (grid coordinates) to their nearest seeds.
  virtual double max_distance(const Box3& box) const = 0;
  /// Encloses the number of seeds per volume of a box of the grid, there.
  virtual Interval density(const Box3& box) const = 0;
  virtual double max_density() const = 0;
  /// Whether a cell of the diagram whose seed is in a box (grid coordinates) may reach where the
  /// foam is needed. Elsewhere rows need not be right.
  virtual bool is_needed(const Box3&) const { return true; }

  virtual void describe(HashInput& input) const = 0;
};

}  // namespace msq
