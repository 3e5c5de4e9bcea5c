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
#include "structure/foam/voronoi_cell.h"

namespace msq {

namespace {

/// A list of neighbours with D^2 at least this holds most cells (cube cells: 97 of 100).
constexpr double first_distance_squared = 4.75;

class EdgeBuilder {
 public:
  EdgeBuilder(const FoamSeeds& seeds, CellIndex corner, std::vector<FoamEdge>& edges)
      : block_(seeds, corner, EdgeBrick::side),
        most_squared_(4 * seeds.empty_radius() * seeds.empty_radius()),
        edges_(edges) {}

  void add_owned_edges(int x, int y, int z) {
    const size_t own = block_.index(x, y, z);
    const Vec3 seed = block_.position(own);
    for (double d2 = std::min(first_distance_squared, most_squared_);;) {
      const size_t count = block_.near(own, d2, near_);
      if (count > VoronoiCell::most_planes || !walk(seed, count)) break;
      // 1e-9: room for the rounding of vertices.
      if (d2 >= most_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
        // Seeds are in the order of cells: those after the own one come last.
        const uint32_t after = static_cast<uint32_t>(
            std::upper_bound(near_.begin(), near_.begin() + static_cast<ptrdiff_t>(count), own) -
            near_.begin());
        cell_.for_each_edge(after, [&](Vec3 from, Vec3 to) { add(seed + from, seed + to); });
        return;
      }
      d2 = std::min(most_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
    }
    add_by_definition(own);
  }

 private:
  void add(Vec3 a, Vec3 b) {
    edges_.push_back({{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)},
                      {static_cast<float>(b.x), static_cast<float>(b.y), static_cast<float>(b.z)}});
  }

  bool walk(Vec3 seed, size_t count) {
    cell_.clear();
    for (size_t i = 0; i < count; ++i) cell_.add(block_.position(near_[i]) - seed);
    return cell_.walk();
  }

  /// Every pair of later neighbours, cut by all others.
  void add_by_definition(size_t own) {
    struct Neighbour {
      Vec3 position;  // relative to the own seed
      double distance_squared;
      bool after;
    };
    const Vec3 seed = block_.position(own);
    const size_t count = block_.near(own, most_squared_, near_);
    std::vector<Neighbour> neighbours;
    for (size_t i = 0; i < count; ++i) {
      const Vec3 d = block_.position(near_[i]) - seed;
      neighbours.push_back({d, dot(d, d), near_[i] > own});
    }
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
        if (line.holds(part)) add(seed + line.at(part.low), seed + line.at(part.high));
      }
    }
  }

  SeedBlock block_;
  double most_squared_;
  std::vector<uint32_t> near_;
  VoronoiCell cell_;
  std::vector<FoamEdge>& edges_;
};

}  // namespace

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner) {
  std::vector<FoamEdge> edges;
  edges.reserve(side * side * side * 15);
  std::vector<uint32_t> starts;
  EdgeBuilder builder(seeds, corner, edges);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      starts.push_back(static_cast<uint32_t>(edges.size()));
      for (int x = 0; x < side; ++x) builder.add_owned_edges(x, y, z);
    }
  segments_ = SegmentSet(edges, starts);
}

std::vector<FoamEdge> EdgeBrick::edges() const {
  std::vector<FoamEdge> edges;
  for (size_t i = 0; i < segments_.count(); ++i) edges.push_back(segments_.at(i));
  return edges;
}

}  // namespace msq
