// SPDX-License-Identifier: Apache-2.0
// The Voronoi cell of one seed among its neighbours, as the edges of a convex polytope.
//
// Method: walk the polytope's edge graph. The midpoint to the nearest neighbour always lies on a
// face. From there, slide to an edge and along it to a vertex. From each vertex, follow its three
// edges to the next vertex, which is the nearest intersection with any plane (a minimum over
// planes, in SIMD), until every edge has both ends. This takes one pass over n planes per edge,
// instead of cutting with n planes one after the other. In the degenerate case (four planes in a
// point) the graph is not that of a simple polytope (Euler: vertices = 2 faces - 4); then the
// caller uses its fallback.
//
// The walk is first tried in single precision. Its vertices are then computed in double precision
// from their three planes and tested against all planes. A vertex on the wrong side of a plane
// shows a wrong turn, and the walk is repeated in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

class VoronoiCell {
 public:
  static constexpr size_t max_planes = 128, max_vertices = 255;

  /// Neighbours as planes in single precision: the input of the kernels.
  struct Planes {
    static constexpr size_t room = max_planes + 64;  // finders write whole vectors
    alignas(64) float x[room], y[room], z[room];     // normals: relative to the cell's own seed
    alignas(64) float offset[room];                  // half squared lengths
    alignas(64) uint32_t seed[room];                 // index of the neighbouring seed
    size_t count = 0;
  };
  struct Vertex {
    uint8_t plane[3];
    Vec3 position;
  };
  struct Graph {
    Vertex vertices[max_vertices];
    size_t count = 0, known = 0;  // total count, and count before the walk
    bool found_anew = false;
    std::vector<uint16_t> ends;  // of half-edge (a, b): epoch << 8 | vertex
    uint32_t epoch = 0;

    uint32_t end(uint32_t a, uint32_t b) const { return ends[a * max_planes + b] & 0xff; }
  };

  /// Forgets all neighbours; new ones are added one by one.
  void clear();
  /// Adds a neighbouring seed, relative to the cell's own; at most max_planes of them.
  void add(Vec3 neighbour);
  size_t count() const { return planes_.count; }
  const Planes& planes() const { return planes_; }
  Planes& planes() { return planes_; }

  /// Forgets all neighbours of the seed `own`. The caller writes new ones into the returned planes,
  /// with indices into `seeds`.
  Planes& refill(const Vec3* seeds, Vec3 own);

  /// Adds a vertex that is already known, relative to the cell's own seed. Its planes are in the
  /// order in which for_each_new_vertex gives them. Returns false if there is no room.
  bool add_vertex(uint32_t a, uint32_t b, uint32_t c, Vec3 position);

  /// Finds the vertices among the planes added. Returns false if the walk fails: degenerate, too
  /// many planes, or unbounded.
  bool walk();

  /// The same for a cell of a power diagram that holds its seed (seeds/seeds.h). The caller has set
  /// the offsets of the planes: half the squared lengths plus half of the lift of a neighbour less
  /// the own one. `lifts`: of `seeds`.
  bool walk_power(const double* lifts, double own_lift);

  /// After walk(): squared distance of the farthest vertex. Seeds at more than twice that distance
  /// cannot cut the cell.
  double radius_squared() const { return radius_squared_; }

  /// After walk(): whether it succeeded only in double precision. Then it found all vertices anew,
  /// including the known ones.
  bool found_anew() const { return graph_.found_anew; }

  /// After walk(): relative to the seed.
  size_t vertex_count() const { return graph_.count; }
  Vec3 vertex(size_t i) const { return graph_.vertices[i].position; }

  /// After walk(): calls visit(v, w, a, b) for the edges, from vertex v to vertex w, between two
  /// neighbours a and b that were both added as number `first` or later.
  template <class Visit>
  void for_each_edge(uint32_t first, Visit&& visit) const;

  /// After walk(): calls visit(planes, position) for the vertices that were not known before, with
  /// the numbers of their three planes, anticlockwise as seen from outside. They follow the known
  /// ones in the order of vertex().
  template <class Visit>
  void for_each_new_vertex(Visit&& visit) const {
    for (size_t v = graph_.known; v < graph_.count; ++v)
      visit(graph_.vertices[v].plane, graph_.vertices[v].position);
  }

 private:
  Planes planes_;
  std::vector<Vec3> added_;
  const Vec3* seeds_ = nullptr;
  Vec3 own_;
  Graph graph_;
  double radius_squared_ = 0;
};

template <class Visit>
void VoronoiCell::for_each_edge(uint32_t first, Visit&& visit) const {
  // Without a branch on which edges are wanted: it would be unpredictable.
  uint16_t wanted[3 * max_vertices];  // vertex << 2 | plane
  size_t count = 0;
  for (size_t v = 0; v < graph_.count; ++v)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = graph_.vertices[v].plane[i], b = graph_.vertices[v].plane[(i + 1) % 3];
      wanted[count] = static_cast<uint16_t>(v << 2 | i);
      count += a >= first && b > a;
    }
  for (size_t n = 0; n < count; ++n) {
    const size_t v = wanted[n] >> 2, i = wanted[n] & 3;
    const uint8_t* plane = graph_.vertices[v].plane;
    const uint32_t a = plane[i], b = plane[i == 2 ? 0 : i + 1];
    visit(v, graph_.end(b, a), a, b);
  }
}

}  // namespace msq
