// SPDX-License-Identifier: Apache-2.0
// The Voronoi edges that the seeds of a brick of cells own, by a walk over Delaunay tetrahedra.
//
// A Voronoi edge is dual to a facet of the Delaunay tetrahedra, and joins the centres of the
// spheres through the two tetrahedra at the facet. The walk takes facets whose far side is unknown,
// finds the seed that a sphere through the facet meets first as it grows to that side, and so the
// next tetrahedron. It follows all facets with a seed in the brick, and finds each tetrahedron
// once; a walk over Voronoi cells (edge_builder.h) handles each vertex in four cells. That walk
// stays for what this one refuses: degenerate seeds, and very flat or long cells.
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
  static constexpr int side = FacetState::max_side;

  /// Whether the walk is worth trying.
  static bool suits(const FoamSeeds& seeds);

  /// Finds the edges owned by the brick of cells^3 cells whose first is `corner`; cells: `side`, or
  /// 4. Returns false if it cannot prove that it has found all of them.
  bool build(const FoamSeeds& seeds, CellIndex corner, int cells = side) {
    return build(seeds, corner, cells, Owners::all(cells));
  }
  /// The edges of some of its seeds.
  bool build(const FoamSeeds& seeds, CellIndex corner, int cells, const Owners& owners);

  /// The result of the last successful build, of a brick of side^3 cells: one run per row of cells
  /// along x, with the edges that the row owns; foam units, from the middle of the brick.
  SegmentSet segments() const;

  // The same edge by edge, for bricks of both sizes.

  /// The cells of an edge's seeds: the owner's from the brick's first cell, and the two others'
  /// from the owner's, in their order; and the numbers of the vertices that it joins.
  struct Edge {
    int owner[3], others[2][3];
    uint32_t ends[2];
  };
  size_t count() const { return s_.starts[side * side]; }
  /// Calls visit(edge) in the order of owners.
  template <class Visit>
  void for_each_edge(Visit&& visit) const;
  /// Vertices, foam units, from the middle of the brick; a few belong to no edge.
  size_t vertex_count() const { return s_.tetrahedra; }
  const float (&vertex(uint32_t number) const)[4] { return s_.centres[number]; }

  /// What FacetCells reads: after a successful build.
  const FacetState& state() const { return s_; }

  size_t bytes() const { return sizeof *this; }

 private:
  void place(const FoamSeeds& seeds, CellIndex corner, int cells);

  FacetState s_;
  SeedTile tile_;
};

template <class Visit>
void FacetWalk::for_each_edge(Visit&& visit) const {
  constexpr int halo = FacetState::halo;
  Edge edge;
  const auto& [low, high] = s_.owners;
  for (edge.owner[2] = low[2]; edge.owner[2] < high[2]; ++edge.owner[2])
    for (edge.owner[1] = low[1]; edge.owner[1] < high[1]; ++edge.owner[1])
      for (edge.owner[0] = low[0]; edge.owner[0] < high[0]; ++edge.owner[0]) {
        const auto bucket =
            static_cast<size_t>((edge.owner[2] * side + edge.owner[1]) * side + edge.owner[0]);
        for (size_t i = 0; i < s_.count[bucket]; ++i) {
          // Keys have the last bits of cells that are at most three cells away, along z after the
          // owner's.
          int key = s_.keys[bucket][i];
          for (int(&other)[3] : edge.others) {
            other[0] = ((key - edge.owner[0] - halo + 3) & 7) - 3;
            other[1] = (((key >> 3) - edge.owner[1] - halo + 3) & 7) - 3;
            other[2] = ((key >> 6) - edge.owner[2] - halo) & 3;
            key >>= 8;
          }
          for (size_t end = 0; end < 2; ++end) edge.ends[end] = s_.ends[bucket][i][end];
          visit(static_cast<const Edge&>(edge));
        }
      }
}

}  // namespace msq
