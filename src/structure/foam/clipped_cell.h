// SPDX-License-Identifier: Apache-2.0
// The Voronoi cell of one seed, cut from a cube by one neighbour after the other.
//
// For cells of more faces than the walk (voronoi_cell.h) has room for, and for seeds on one sphere,
// where it fails. Vertices are triples of planes that know their three neighbours; a cut removes
// the vertices beyond it and joins the loop of planes about the hole with the new one, as in N.
// Ray, D. Sokolov, S. Lefebvre and B. Levy, "Meshless Voronoi on the GPU", 2018. A plane that goes
// no deeper than a tolerance beyond a vertex leaves it: where more than three planes meet in a
// point, those that come late are left out there, and the polytope stays simple.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

class ClippedCell {
 public:
  struct Vertex {
    uint32_t plane[3];  // counter-clockwise seen from outside; 0 to 5 are the cube's
    uint32_t next[3];   // the vertex across the edge of plane[i] and plane[i + 1]
    Vec3 position;      // relative to the seed
    bool is_there;
  };
  static constexpr uint32_t first_neighbour = 6;

  /// A cube about the seed.
  void start(double half_width);
  /// Cuts off what is nearer to a neighbour (relative to the seed), which becomes plane number
  /// first_neighbour + the number of cuts before. False if rounding has made a polytope impossible;
  /// start() again then.
  bool cut(Vec3 neighbour);

  /// Vertices by number; some are no longer there. Those from `made()` on are of the last cut.
  const std::vector<Vertex>& vertices() const { return vertices_; }
  size_t made() const { return made_; }

  /// visit(v, w) for the edges, from vertex v to vertex w, between two planes that both
  /// wanted(plane).
  template <class Wanted, class Visit>
  void for_each_edge(Wanted&& wanted, Visit&& visit) const {
    for (const Vertex& vertex : vertices_)
      for (int i = 0; vertex.is_there && i < 3; ++i) {
        const uint32_t a = vertex.plane[i], b = vertex.plane[(i + 1) % 3];
        if (a < b && wanted(a) && wanted(b))
          visit(vertex.position, vertices_[vertex.next[i]].position);
      }
  }

  /// By how much a vertex v may be beyond a plane: a part of |v|^2 or of 1.
  static constexpr double tolerance = 1e-12;

 private:
  struct Plane {
    Vec3 normal;
    double offset;
    uint32_t start;  // the new vertex whose plane[0] it is, in the cut of number `cut`
    uint32_t cut;
  };
  struct Side {
    uint32_t a, b, outside;  // planes of an edge about the hole, and the vertex that stays
  };

  void place(Vertex& vertex) const;

  std::vector<Plane> planes_;
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> removed_;
  std::vector<Side> hole_;
  size_t made_ = 0;
  uint32_t cuts_ = 0;
};

}  // namespace msq
