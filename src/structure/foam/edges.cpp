// SPDX-License-Identifier: Apache-2.0
// Each seed's Voronoi cell is found by a walk (voronoi_cell.h) among the seeds within some distance
// D of it. It is the true cell if its farthest vertex is within D / 2: a seed farther than D is
// farther than twice any vertex, and cuts nothing. If not, D grows, up to twice the empty radius,
// beyond which no seed can matter. Where the walk fails (seeds on one sphere, low jitter), every
// pair of neighbours is tried by the definition itself (edge_line.h), which needs no graph.
#include "structure/foam/edges.h"

#include <algorithm>

#include "structure/foam/edge_line.h"
#include "structure/foam/seed_block.h"
#include "structure/foam/shared_vertices.h"
#include "structure/foam/voronoi_cell.h"

namespace msq {

namespace {

/// A list of neighbours with D^2 at least this holds most cells (cube cells: 97 of 100).
constexpr double first_distance_squared = 4.75;

/// Works for one brick after another, in memory that it keeps.
class EdgeBuilder {
 public:
  void move_to(const FoamSeeds& seeds, CellIndex corner) {
    block_.move_to(seeds, corner, EdgeBrick::side, first_distance_squared);
    shared_.reset(block_);
    most_squared_ = 4 * seeds.empty_radius() * seeds.empty_radius();
  }

  /// Appends the edges that a seed owns; seeds in the order of their cells.
  void add_owned_edges(int x, int y, int z, std::vector<FoamEdge>& edges) {
    const size_t own = block_.index(x, y, z);
    const double needed = std::max(first_distance_squared, shared_.needed(block_, own));
    for (double d2 = std::min(needed, most_squared_);;) {
      const uint32_t before = static_cast<uint32_t>(block_.refill(cell_, own, d2));
      if (cell_.count() > VoronoiCell::most_planes) break;
      shared_.give(block_, own, cell_);
      if (!cell_.walk()) break;
      // 1e-9: room for the rounding of vertices.
      if (d2 >= most_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
        shared_.take(block_, own, before, cell_);
        return add_edges(block_.position(own), before, edges);
      }
      d2 = std::min(most_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
    }
    add_by_definition(own, edges);
  }

 private:
  static void put(Vec3 p, float* out) {
    for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(p[axis]);
  }

  /// Planes are in the order of cells: those before the own come first.
  void add_edges(Vec3 seed, uint32_t before, std::vector<FoamEdge>& edges) {
    float positions[VoronoiCell::most_vertices][3];
    for (size_t v = 0; v < cell_.vertex_count(); ++v) put(seed + cell_.vertex(v), positions[v]);
    cell_.for_each_edge(before, [&](size_t from, size_t to) {
      FoamEdge edge;
      std::copy_n(positions[from], 3, edge.a);
      std::copy_n(positions[to], 3, edge.b);
      edges.push_back(edge);
    });
  }

  /// Every pair of later neighbours, cut by all others.
  void add_by_definition(size_t own, std::vector<FoamEdge>& edges) {
    struct Neighbour {
      Vec3 position;  // relative to the own seed
      double distance_squared;
      bool after;
    };
    const Vec3 seed = block_.position(own);
    std::vector<Neighbour> neighbours;
    for (size_t i = 0; i < block_.positions().size(); ++i) {
      const Vec3 d = block_.position(i) - seed;
      const double squared = dot(d, d);
      if (i != own && squared <= most_squared_ * (1 + 1e-9))
        neighbours.push_back({d, squared, i > own});
    }
    const size_t count = neighbours.size();
    std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.distance_squared < b.distance_squared;
    });
    for (size_t i = 0; i < count; ++i) {
      if (!neighbours[i].after) continue;
      for (size_t j = i + 1; j < count; ++j) {
        if (!neighbours[j].after) continue;
        const EdgeLine line(Vec3{}, neighbours[i].position, neighbours[j].position);
        if (!line.exists()) continue;
        LineInterval part{-1e300, 1e300};
        for (size_t k = 0; k < count && line.holds(part); ++k)
          if (k != i && k != j) line.cut(neighbours[k].position, part);
        if (!line.holds(part)) continue;
        FoamEdge edge;
        put(seed + line.at(part.low), edge.a);
        put(seed + line.at(part.high), edge.b);
        edges.push_back(edge);
      }
    }
  }

  SeedBlock block_;
  SharedVertices shared_;
  VoronoiCell cell_;
  double most_squared_ = 0;
};

}  // namespace

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner) {
  thread_local EdgeBuilder builder;
  thread_local std::vector<FoamEdge> edges;
  std::vector<uint32_t> starts;
  edges.clear();
  builder.move_to(seeds, corner);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      starts.push_back(static_cast<uint32_t>(edges.size()));
      for (int x = 0; x < side; ++x) builder.add_owned_edges(x, y, z, edges);
    }
  segments_ = SegmentSet(edges, starts);
}

std::vector<FoamEdge> EdgeBrick::edges() const {
  std::vector<FoamEdge> edges;
  for (size_t i = 0; i < segments_.count(); ++i) edges.push_back(segments_.at(i));
  return edges;
}

}  // namespace msq
