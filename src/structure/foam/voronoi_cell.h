// SPDX-License-Identifier: Apache-2.0
// The Voronoi cell of one seed among its neighbours, as the edges of a convex polytope.
//
// Method: walk the polytope's edge graph. From the midpoint to the nearest neighbour, which always
// lies on a face, slide to an edge and along it to a vertex; from each vertex follow its three
// edges to the next vertex, which is where the first of all planes is met (a minimum over planes,
// in SIMD), until every edge has both ends. One pass over n planes an edge, instead of cutting with
// n planes one after the other; the degenerate (four planes in a point) shows as a graph that is
// not one of a simple polytope (Euler: vertices = 2 faces - 4), and is left to the caller's
// fallback.
//
// The walk is first tried in single precision. Its vertices are then computed in double precision
// from their three planes and tested against all planes: a vertex on the wrong side of one shows a
// wrong turn, and the walk is done again in double precision.
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
  size_t count() const { return count_; }
  /// A neighbouring seed, relative to the cell's own; at most most_planes of them.
  void add(Vec3 neighbour);

  /// Finds the vertices among the planes added. False if the walk fails: degenerate, or not
  /// bounded.
  bool walk();

  /// After walk(): squared distance of the farthest vertex. Seeds at more than twice that distance
  /// cannot cut the cell.
  double radius_squared() const { return radius_squared_; }

  /// After walk(): visit(from, to), relative to the seed, for the edges between two neighbours that
  /// were both added as number `first` or later.
  template <class Visit>
  void for_each_edge(uint32_t first, Visit&& visit) const;

  /// What the kernels work on.
  struct Planes {
    alignas(64) double x[most_planes], y[most_planes], z[most_planes];  // normals
    alignas(64) double offset[most_planes];                             // half squared lengths
    alignas(64) float fx[most_planes], fy[most_planes], fz[most_planes], foffset[most_planes];
  };
  struct Vertex {
    uint16_t plane[3];
    Vec3 position;
  };
  struct Graph {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> ends;  // of half-edge (a, b): epoch << 16 | vertex
    uint32_t epoch = 0;

    uint32_t end(uint32_t a, uint32_t b) const { return ends[a * most_planes + b] & 0xffff; }
  };

 private:
  Planes planes_;
  size_t count_ = 0;
  Graph graph_;
  double radius_squared_ = 0;
};

template <class Visit>
void VoronoiCell::for_each_edge(uint32_t first, Visit&& visit) const {
  for (const Vertex& vertex : graph_.vertices)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = vertex.plane[i], b = vertex.plane[(i + 1) % 3];
      if (a >= first && b > a) visit(vertex.position, graph_.vertices[graph_.end(b, a)].position);
    }
}

}  // namespace msq
