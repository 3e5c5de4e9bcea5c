// SPDX-License-Identifier: Apache-2.0
// The Voronoi cell of one seed, or its cell of a power diagram, cut from a cube by one neighbour
// after the other.
//
// For cells of power diagrams (weighted_cells.h), cells with more faces than the walk
// (voronoi_cell.h) has room for, and for seeds on one sphere, where it fails. Vertices are triples
// of planes with references to their three neighbours. A cut removes the vertices beyond it and
// joins the loop of planes around the hole with the new plane, as in N. Ray, D. Sokolov, S.
// Lefebvre and B. Levy, "Meshless Voronoi on the GPU", 2018. A plane that passes a vertex by no
// more than a tolerance does not remove it. If more than three planes meet in a point, the later
// ones are left out there, and the polytope stays simple.
#pragma once

#include <algorithm>
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
  /// Cuts off the part nearer to a neighbour (relative to the seed). The neighbour becomes plane
  /// number first_neighbour + the number of cuts before. Returns false if rounding has made a
  /// polytope impossible; call start() again then.
  bool cut(Vec3 neighbour) { return cut(neighbour, 0.5 * dot(neighbour, neighbour)); }
  /// The same with the plane neighbour . x = offset, from the seed. Also returns false if nothing
  /// is left: is_empty().
  bool cut(Vec3 neighbour, double offset);
  bool is_empty() const { return is_empty_; }

  /// Starts with the cube and cuts with neighbours, which have a `position` and its
  /// `distance_squared` and ascend by it, until no vertex is farther than half the distance.
  /// `max_squared`: squared distance from the seed of points that may be in the cell. Returns false
  /// if rounding has made a polytope impossible.
  template <class Neighbour>
  bool cut_by(const std::vector<Neighbour>& neighbours, double half_width, double max_squared) {
    start(half_width);
    double farthest_squared = max_squared;
    for (const Neighbour& n : neighbours) {
      if (n.distance_squared > 4 * farthest_squared * (1 + 1e-9)) break;
      if (!cut(n.position)) return false;
      if (made() == vertices_.size()) continue;
      farthest_squared = 0;
      for (const Vertex& vertex : vertices_)
        if (vertex.is_there)
          farthest_squared = std::max(farthest_squared, dot(vertex.position, vertex.position));
    }
    return true;
  }

  /// Vertices by number; some are removed. Those from `made()` on are from the last cut.
  const std::vector<Vertex>& vertices() const { return vertices_; }
  size_t made() const { return made_; }

  /// Calls visit(v, w) for the edges, from vertex v to vertex w, between two planes for which
  /// wanted(plane) is true.
  template <class Wanted, class Visit>
  void for_each_edge(Wanted&& wanted, Visit&& visit) const {
    for (const Vertex& vertex : vertices_)
      for (int i = 0; vertex.is_there && i < 3; ++i) {
        const uint32_t a = vertex.plane[i], b = vertex.plane[(i + 1) % 3];
        if (a < b && wanted(a) && wanted(b))
          visit(vertex.position, vertices_[vertex.next[i]].position);
      }
  }

  /// Maximum distance of a vertex v beyond a plane, relative to |v|^2 or to 1.
  static constexpr double tolerance = 1e-12;

 private:
  struct Plane {
    Vec3 normal;
    double offset;
    uint32_t start;  // the new vertex whose plane[0] this is, in cut number `cut`
    uint32_t cut;
  };
  struct Side {
    uint32_t a, b, outside;  // planes of an edge of the hole, and the remaining vertex
  };

  void place(Vertex& vertex) const;

  std::vector<Plane> planes_;
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> removed_;
  std::vector<Side> hole_;
  size_t made_ = 0;
  uint32_t cuts_ = 0;
  bool is_empty_ = false;
};

}  // namespace msq
