// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam whose density varies: neighbourhood cells are refined by recursive 2x2x2
// subdivision, and every leaf holds one jittered seed. Source: Martinez, Dumas and Lefebvre,
// "Procedural Voronoi foams for additive manufacturing", 2016 (graded foams).
//
// A node of level l measures 2^-l of its cell. With density d (seeds per volume of a cell) at its
// centre, m = d / 8^l seeds are expected in it. It is a leaf where m <= 1, splits where m >= 8, and
// between splits with probability (m - 1) / 7: one seed or about eight, m on average. So a constant
// density is met in the mean, and 8^k exactly. All of it follows from cell, path and seed number
// alone, and whoever asks about a node gets the same answer: neighbours of unlike level agree.
//
// Bounds. Every leaf holds its seed, so a point is within the diagonal of its own leaf of a seed:
// empty balls have radius at most that, and at most that of a cell.
//
// Positions are in foam units and relative to a cell near by (seeds.h). A seed is at a multiple of
// 2^-(21 + l) of its cell; with at most five levels and cubic cells, differences stay exact. A cell
// of one leaf has the seed of FoamSeeds, bit for bit.
#pragma once

#include "cell/neighbourhood.h"
#include "field/field.h"
#include "structure/foam/seeds.h"

namespace msq {

class GradedSeeds {
 public:
  static constexpr int most_levels = 5;
  static constexpr double most_density = 32768;  ///< 8^most_levels

  /// A node of the octree of a cell. The path is 1 for the cell and 8 path + octant for a child;
  /// octants count x first, then y, then z.
  struct Node {
    CellIndex cell;
    int level = 0;
    uint32_t path = 1;
    Vec3 low = {};  ///< corner, in the cell, whose box has size 1

    double size() const { return 1.0 / (1 << level); }
    Node child(uint32_t octant) const {
      const double half = 0.5 * size();
      return {cell, level + 1, path << 3 | octant,
              low + Vec3{double(octant & 1), double(octant >> 1 & 1), double(octant >> 2)} * half};
    }
    /// Ascends from leaf to leaf in the order of paths; below 2^15.
    uint32_t order() const { return (path - (1u << (3 * level))) << (3 * (most_levels - level)); }
  };

  /// `density` is at least 0 and at most most_density; where it is below 1, it counts as 1.
  GradedSeeds(const FoamSeeds& cells, const Neighbourhood& grid, Parameter density)
      : cells_(cells), grid_(grid), density_(std::move(density)) {}

  const FoamSeeds& cells() const { return cells_; }
  Vec3 scale() const { return cells_.scale(); }

  bool splits(const Node& node) const;
  /// The seed of a leaf, in its cell, whose box has size 1.
  Vec3 in_leaf(const Node& leaf) const;

  /// Levels that all leaves about the points of a box (grid coordinates) have at least.
  int least_level(const Box3& box) const;
  /// Whether the seeds of the brick whose first cell is `corner` may own edges that touch a box
  /// (grid coordinates).
  bool may_own_edges(CellIndex corner, const Box3& box) const;
  /// Seeds to expect in a cell of a box (grid coordinates), about.
  double mean_density(const Box3& box) const;
  /// Cells along each side of a brick whose edges are built and kept together.
  int brick_side() const;

 private:
  FoamSeeds cells_;
  Neighbourhood grid_;
  Parameter density_;
};

}  // namespace msq
