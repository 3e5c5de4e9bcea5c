// SPDX-License-Identifier: Apache-2.0
// The Voronoi cell of one seed among its neighbours, as the edges of a convex polytope.
//
// Method: walk the polytope's edge graph. From the midpoint to the nearest neighbour, which always
// lies on a face, slide to an edge and along it to a vertex; from each vertex follow its three edges
// to the next vertex, which is where the first of all planes is met (a minimum over planes, in SIMD),
// until every edge has both ends. One pass over n planes an edge, instead of cutting with n planes
// one after the other; the degenerate (four planes in a point) shows as a graph that is not one of a
// simple polytope (Euler: vertices = 2 faces - 4), and is left to the caller's fallback.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

class VoronoiCell {
 public:
  static constexpr size_t most_planes = 128, most_vertices = 256;

  /// Forgets all neighbours.
  void clear() { count_ = 0; }
  bool full() const { return count_ == most_planes; }
  size_t count() const { return count_; }
  /// A neighbouring seed, relative to the cell's own; not when full().
  void add(Vec3 neighbour);

  /// Finds the edges among the planes added. False if the walk fails: degenerate, or not bounded.
  bool walk();

  /// After walk(): squared distance of the farthest vertex. Seeds at more than twice that distance
  /// cannot cut the cell.
  double radius_squared() const { return radius_squared_; }

  struct Edge {
    uint32_t a, b;  ///< the two neighbours, in order of addition; a < b
    Vec3 from, to;  ///< ends, relative to the seed
  };
  /// After walk(): calls visit(a, b) -> bool, and where it answers true, edge(Edge).
  template <class Wanted, class Visit>
  void for_each_edge(Wanted&& wanted, Visit&& visit) const;

  /// Arrays that the kernel works on.
  struct Planes {
    alignas(64) double x[most_planes], y[most_planes], z[most_planes];  // normals
    alignas(64) double offset[most_planes];                             // half squared lengths
  };
  struct Vertex {
    uint16_t plane[3];
    Vec3 position;
  };

 private:
  /// Where three planes meet, from the planes themselves: the walk's own position drifts.
  Vec3 corner(const Vertex& vertex) const;

  Planes planes_;
  size_t count_ = 0;
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> ends_;  // of half-edge (a, b): epoch << 16 | vertex
  uint32_t epoch_ = 0;
  double radius_squared_ = 0;
};

template <class Wanted, class Visit>
void VoronoiCell::for_each_edge(Wanted&& wanted, Visit&& visit) const {
  for (const Vertex& vertex : vertices_)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = vertex.plane[i], b = vertex.plane[(i + 1) % 3];
      if (a > b || !wanted(a, b)) continue;
      const Vertex& other = vertices_[ends_[b * most_planes + a] & 0xffff];
      visit(Edge{a, b, corner(vertex), corner(other)});
    }
}

}  // namespace msq
