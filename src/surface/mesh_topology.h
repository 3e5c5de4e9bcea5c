// SPDX-License-Identifier: Apache-2.0
// How a mesh is connected, before any vertex has a place: one vertex for each loop of crossings in
// a cell, one polygon around each edge with a crossing, of the vertices of the four cells about it.
// Source: Schaefer, Ju and Warren, "Manifold dual contouring", 2007; Nielson, "Dual marching
// cubes", 2004.
//
// This is the dual of the surface that the loops bound, which is a closed manifold. Two polygons
// would share two edges where the two arcs of an ambiguous face belong to the same loop on both of
// its sides (Wenger, "Isosurfaces", 2013, 2.3). There each arc gets a vertex of its own, and the
// four polygons about the face one in their middle, on the crossing. Everything else has two
// triangles to an edge already.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "base/job.h"
#include "surface/cell_loops.h"
#include "surface/mesh_nodes.h"

namespace msq {

struct AmbiguousCell {
  uint32_t column;
  uint8_t corners;
  uint8_t centres;  ///< as in find_loops()
};

/// An edge of the grid along an axis from node (column, row, layer).
struct GridEdge {
  uint32_t layer;
  int axis;
  uint32_t row, column;

  friend auto operator<=>(const GridEdge&, const GridEdge&) = default;
};

/// The vertex of an arc of a face: on the way from a corner of the face to its middle.
struct ArcVertex {
  uint32_t cell[3];    ///< whose face it is
  uint8_t face, turn;  ///< of CellFace: the corner, and the edges before and behind it
  bool corner_inside;
};

/// The number of the first cell around an edge is that of the cell before it along both other axes,
/// the axes in cyclic order; the others follow in the sense of that order.
unsigned place_around_edge(unsigned edge);

class MeshTopology {
 public:
  MeshTopology(const Model& model, const Scales& resolved, const MeshNodes& nodes)
      : model_(model), resolved_(resolved), nodes_(nodes) {}

  /// Of a layer of cells. Vertices and triangles are numbered from the first of the mesh on.
  struct Layer {
    uint64_t first_vertex = 0;
    std::vector<uint32_t> starts;   ///< of the vertices of each row of cells, and their end
    std::vector<ArcVertex> arcs;    ///< their vertices come behind those of cells
    std::vector<GridEdge> middles;  ///< then those in the middle of polygons, in order
    uint64_t vertices = 0, triangles = 0;
    /// Those that find_loops() needs the centres of faces for, by rows.
    std::vector<std::vector<AmbiguousCell>> ambiguous;
  };

  /// Appends the next layers of cells, [first, end), whose nodes are loaded; and forgets all but
  /// the last layer before them. Throws Error(limit) for 2^32 vertices.
  void add(uint32_t first, uint32_t end, Job* job);
  const Layer& layer(uint32_t k) const { return layers_[k - first_]; }

  /// Calls visit(i, corners, loops) for each cell of a row with a boundary.
  template <class Visit>
  void for_each_cell(uint32_t j, uint32_t k, Visit&& visit) const {
    const CellTable& table = cell_table();
    const std::vector<AmbiguousCell>& special = layer(k).ambiguous[j];
    auto next = special.begin();
    nodes_.for_each_cell(j, k, [&](uint32_t i, unsigned corners) {
      if (next == special.end() || next->column != i)
        return visit(i, corners, table.loops[corners]);
      const CellLoops loops = find_loops(corners, next->centres);
      ++next;
      visit(i, corners, loops);
    });
  }

  /// The vertex between the cells at places `side` and side + 1 around an edge, if there is one.
  bool find_arc(const GridEdge& edge, unsigned side, uint32_t& vertex) const {
    const auto found = on_sides_.find({edge, side});
    if (found == on_sides_.end()) return false;
    vertex = found->second;
    return true;
  }
  /// Number of the vertex in the middle of the polygon of an edge: one of
  /// layer(edge.layer).middles.
  uint32_t middle(const GridEdge& edge) const;

  uint64_t vertices() const { return vertices_; }
  uint64_t triangles() const { return triangles_; }

 private:
  struct Side {
    GridEdge edge;
    unsigned side;
    friend auto operator<=>(const Side&, const Side&) = default;
  };
  void find_ambiguous(uint32_t first, uint32_t end, Job* job);
  void number(uint32_t k, const Job* job);
  void find_arcs(uint32_t k);
  bool joins_arcs(uint32_t k, uint32_t j, const AmbiguousCell& cell, unsigned face) const;

  const Model& model_;
  const Scales& resolved_;
  const MeshNodes& nodes_;
  uint32_t first_ = 0;
  std::vector<Layer> layers_;  // from first_ on
  std::map<Side, uint32_t> on_sides_;
  uint64_t vertices_ = 0, triangles_ = 0;
};

}  // namespace msq
