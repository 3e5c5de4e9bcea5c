// SPDX-License-Identifier: Apache-2.0
// The Voronoi edges that the seeds of a brick of cells own, by a walk over Delaunay tetrahedra.
//
// A Voronoi edge is dual to a facet of the Delaunay tetrahedra, and joins the centres of the
// spheres through the two tetrahedra at the facet. The walk takes facets whose far side is unknown,
// finds the seed that a sphere through the facet meets first as it grows to that side, and so the
// next tetrahedron. It follows all facets with a seed in the brick, and finds each tetrahedron
// once; a walk over Voronoi cells (edge_builder.h) handles each vertex in four cells. That walk
// stays for what this one refuses: degenerate seeds, very flat or long cells, and rays, which also
// need the seeds of edges.
//
// Why the result is right: see docs/decisions/024-edges-by-tetrahedra.md and facet_walk.cpp.
#pragma once

#include <cstddef>

#include "structure/foam/edges/facet_state.h"
#include "structure/foam/seeds/seed_tile.h"
#include "structure/foam/seeds/seeds.h"
#include "strut/segment_set.h"

namespace msq {

/// Works for one brick after another and reuses its memory: 2 MB, of which it touches 1 MB.
class FacetWalk {
 public:
  /// Cells along each axis of a brick.
  static constexpr int side = FacetState::side;

  /// Whether the walk is worth trying.
  static bool suits(const FoamSeeds& seeds);

  /// Finds the edges owned by the brick of side^3 cells whose first is `corner`. Returns false if
  /// it cannot prove that it has found all of them.
  bool build(const FoamSeeds& seeds, CellIndex corner);

  /// The result of the last successful build: one run per row of cells along x, with the edges that
  /// the row owns; foam units, from the middle of the brick.
  SegmentSet segments() const;

  size_t bytes() const { return sizeof *this; }

 private:
  void place(const FoamSeeds& seeds, CellIndex corner);

  FacetState s_;
  SeedTile tile_;
};

}  // namespace msq
