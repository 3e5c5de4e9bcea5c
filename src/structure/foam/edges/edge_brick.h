// SPDX-License-Identifier: Apache-2.0
// The edges of a foam's Voronoi diagram, each once.
//
// The owner of an edge is the first of its three seeds by cell (z, then y, then x). The bricks of
// cells together own every edge of the diagram exactly once.
#pragma once

#include <vector>

#include "cell/cache.h"
#include "structure/foam/edges/owners.h"
#include "structure/foam/seeds/seeds.h"
#include "strut/segment_set.h"

namespace msq {

/// Foam units, from the corner of the brick's first cell.
struct FoamEdge {
  Vec3 a, b;
};

/// Segments are in single precision, relative to the middle of bricks of 8 cells and to the corner
/// of smaller ones. Owners lie within 4 units of that point, and their edges within the empty
/// radius, at most 2, of owners. So coordinates stay below 8, roundings below 2^-22 in each and
/// 4.2e-7 together. The rest of edge_error is for the vertices themselves, in double precision.
constexpr double edge_error = 5e-7;

/// The edges owned by the seeds of a brick of cells.
class EdgeBrick final : public CellData {
 public:
  /// Cells along each axis. Bricks begin `lead` cells before multiples of `side`. Owners of edges
  /// that touch a box are up to 2 cells (cubes) around it. So boxes of 8 cells that begin at
  /// multiples of 8, as those of whole parts and slabs often do, need few bricks.
  static constexpr int side = 8, lead = 2;

  /// The brick whose first cell is `corner`: by the walk over tetrahedra (facet_walk.h), or, where
  /// that gives up, over Voronoi cells.
  EdgeBrick(const FoamSeeds& seeds, CellIndex corner);
  /// Of such a brick, the edges that some of its seeds own, or all.
  EdgeBrick(const FoamSeeds& seeds, CellIndex corner, const Owners& owners);
  /// By the walk over Voronoi cells (edge_builder.h), which works for all seeds. The same edges, in
  /// another order within each owner.
  static EdgeBrick by_cells(const FoamSeeds& seeds, CellIndex corner);
  /// Of the power diagram of weighted seeds (weighted_edges.h).
  static EdgeBrick of_weighted(const FoamSeeds& seeds, CellIndex corner);
  /// From edges that were found in another way, relative to the brick's corner, in runs as in
  /// SegmentSet.
  EdgeBrick(const std::vector<FloatSegment>& edges, const std::vector<uint32_t>& starts)
      : segments_(edges, starts) {}

  /// A brick in the space of the diagram, moved back to model space (seeds/stretch.h): coordinates
  /// times the factors.
  EdgeBrick(const EdgeBrick& of_diagram, Vec3 factor)
      : origin_(of_diagram.origin_ * factor), segments_(of_diagram.segments_.stretched(factor)) {}

  /// One run per row of cells along x, with the edges that the row owns; foam units, from origin().
  const SegmentSet& segments() const { return segments_; }
  /// Relative to the corner of the brick's first cell.
  Vec3 origin() const { return origin_; }
  /// Returns a copy, edge by edge.
  std::vector<FoamEdge> edges() const;
  /// Whether it has all edges that these seeds own.
  bool holds(const Owners& owners) const { return owners_.hold(owners); }
  uint64_t bytes() const override { return sizeof *this + segments_.bytes(); }

 private:
  EdgeBrick() = default;

  Vec3 origin_;
  SegmentSet segments_;
  Owners owners_ = Owners::all(side);
};

}  // namespace msq
