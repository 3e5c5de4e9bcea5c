// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam whose density varies. Neighbourhood cells are refined by recursive 2x2x2
// subdivision, and every leaf holds one jittered seed. Source: Martinez, Dumas and Lefebvre,
// "Procedural Voronoi foams for additive manufacturing", 2016 (graded foams).
//
// A node of level l measures 2^-l of its cell. With density d (seeds per volume of a cell) at its
// centre, it is expected to contain m = d / 8^l seeds. It is a leaf if m <= 1, splits if m >= 8,
// and in between splits with probability (m - 1) / 7: one seed or about eight, m on average. So a
// constant density is met on average, and exactly if it is 8^k. All of it follows from cell,
// path and seed number alone, so every query of a node gives the same result: neighbours of
// different levels agree.
//
// Bounds. Every leaf holds its seed, so the distance of a point to the nearest seed is at most the
// diagonal of the point's leaf. Empty balls have at most that radius, and at most the diagonal of a
// cell.
//
// Other foams have more than one seed in a cell, too: those whose seeds a map places
// (placed_seeds.h). Their cells are the boxes of the map, and have no octrees, but lists of seeds.
// All that uses graded seeds through SeedTrees (seed_trees.h) and the bounds below serves them.
//
// Positions are in foam units and relative to a nearby cell (seeds.h). A seed is at a multiple of
// 2^-(21 + l) of its cell; with at most five levels and cubic cells, differences stay exact. A cell
// of one leaf has the seed of FoamSeeds, bit for bit.
#pragma once

#include <memory>

#include "cell/neighbourhood.h"
#include "field/field.h"
#include "structure/foam/seeds/placed_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class GradedSeeds {
 public:
  static constexpr int max_levels = 5;
  static constexpr double max_density = 32768;  ///< 8^max_levels

  /// A node of the octree of a cell. The path is 1 for the cell and 8 path + octant for a child;
  /// octants count x first, then y, then z.
  struct Node {
    CellIndex cell;
    int level = 0;
    uint32_t path = 1;
    Vec3 low = {};  ///< corner, relative to the cell, whose box has size 1

    double size() const { return 1.0 / (1 << level); }
    Node child(uint32_t octant) const {
      const double half = 0.5 * size();
      return {cell, level + 1, path << 3 | octant,
              low + Vec3{double(octant & 1), double(octant >> 1 & 1), double(octant >> 2)} * half};
    }
    /// Ascends from leaf to leaf in the order of paths; below 2^15.
    uint32_t order() const { return (path - (1u << (3 * level))) << (3 * (max_levels - level)); }
  };

  /// `density` is from 0 to max_density; values below 1 count as 1.
  GradedSeeds(const FoamSeeds& cells, const Neighbourhood& grid, Parameter density)
      : cells_(cells), grid_(grid), density_(std::move(density)) {}

  /// `cells` and `grid`: of the boxes.
  GradedSeeds(const FoamSeeds& cells, std::shared_ptr<const PlacedSeeds> placed)
      : cells_(cells), grid_(placed->grid()), placed_(std::move(placed)) {}

  const FoamSeeds& cells() const { return cells_; }
  /// Null where cells have octrees.
  const PlacedSeeds* placed() const { return placed_.get(); }
  Vec3 scale() const { return cells_.scale(); }
  void describe(HashInput& input) const;

  // Of octrees:
  bool splits(const Node& node) const;
  /// The seed of a leaf, in its cell, whose box has size 1.
  Vec3 in_leaf(const Node& leaf) const;
  /// The least level at which no node is expected to contain more than eight seeds. So the children
  /// of its nodes are leaves.
  int twig_level() const;

  // Of both:
  /// Bounds the distance of the points of a box (grid coordinates) to their nearest seeds; model
  /// units.
  double max_distance(const Box3& box) const;
  /// Whether the seeds of the brick whose first cell is `corner` may own edges that touch a box
  /// (grid coordinates).
  bool may_own_edges(CellIndex corner, const Box3& box) const;
  /// Whether cells of the diagram whose seeds are in the brick may reach where the foam is needed
  /// (placed_seeds.h).
  bool is_needed(CellIndex corner) const;
  /// Approximate mean number of seeds in a cell of a box (grid coordinates).
  double mean_density(const Box3& box) const;
  /// Cells along each side of a brick whose edges are built and kept together.
  int brick_side() const;

 private:
  /// That of a brick.
  Box3 box_of(CellIndex corner) const;
  /// The minimum level of all leaves around the points of a box (grid coordinates).
  int min_level(const Box3& box) const;

  FoamSeeds cells_;
  Neighbourhood grid_;
  Parameter density_;
  std::shared_ptr<const PlacedSeeds> placed_;
};

}  // namespace msq
