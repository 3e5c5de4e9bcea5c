// SPDX-License-Identifier: Apache-2.0
// Each seed's Voronoi cell is found by a walk (voronoi_cell.h) among the seeds within some distance
// D of it. It is the true cell if its farthest vertex is within D / 2: a seed farther than D is
// farther than twice any vertex, and cuts nothing. If not, D grows, up to twice the empty radius,
// beyond which no seed can matter. Where the walk fails (seeds on one sphere, low jitter), every
// pair of neighbours is tried by the definition itself (edge_line.h), which needs no graph.
#include "structure/foam/edges.h"

#include <algorithm>
#include <array>

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
  /// Nodes are relative to `origin`, which is from the brick's corner.
  SegmentSet build(const FoamSeeds& seeds, CellIndex corner, Vec3 origin) {
    constexpr int side = EdgeBrick::side;
    block_.move_to(seeds, corner, side, first_distance_squared);
    shared_.reset(block_);
    most_squared_ = 4 * seeds.empty_radius() * seeds.empty_radius();
    ends_.clear();
    starts_.clear();
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y) {
        starts_.push_back(static_cast<uint32_t>(ends_.size()));
        for (int x = 0; x < side; ++x) add_owned_edges(block_.index(x, y, z));
      }
    number_nodes(origin);
    return SegmentSet(nodes_, ends_, starts_);
  }

 private:
  /// Seeds come in the order of their cells.
  void add_owned_edges(size_t own) {
    const double needed = std::max(first_distance_squared, shared_.needed(own));
    for (double d2 = std::min(needed, most_squared_);;) {
      const uint32_t before = static_cast<uint32_t>(block_.refill(cell_, own, d2));
      if (cell_.count() > VoronoiCell::most_planes) break;
      shared_.give(block_, own, cell_);
      if (!cell_.walk()) break;
      // 1e-9: room for the rounding of vertices.
      if (d2 >= most_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
        shared_.take(block_, own, before, cell_);
        const std::vector<uint32_t>& numbers = shared_.numbers();
        // Planes are in the order of cells: those before the own come first.
        cell_.for_each_edge(before, [&](size_t from, size_t to) {
          ends_.push_back({numbers[from], numbers[to]});
        });
        return;
      }
      d2 = std::min(most_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
    }
    add_by_definition(own);
  }

  /// From numbers of all vertices found to those of the vertices that edges end at.
  void number_nodes(Vec3 origin) {
    constexpr uint32_t none = ~uint32_t{0};
    node_.assign(shared_.count(), none);
    nodes_.clear();
    for (std::array<uint32_t, 2>& ends : ends_)
      for (uint32_t& end : ends) {
        if (node_[end] == none) {
          node_[end] = static_cast<uint32_t>(nodes_.size());
          const Vec3 p = shared_.position(end) - origin;
          nodes_.push_back(
              {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        }
        end = node_[end];
      }
  }

  /// Every pair of later neighbours, cut by all others.
  void add_by_definition(size_t own) {
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
        if (line.holds(part))
          ends_.push_back(
              {shared_.take(seed + line.at(part.low)), shared_.take(seed + line.at(part.high))});
      }
    }
  }

  SeedBlock block_;
  SharedVertices shared_;
  VoronoiCell cell_;
  double most_squared_ = 0;
  std::vector<std::array<uint32_t, 2>> ends_;  // numbers of shared_, later of nodes_
  std::vector<uint32_t> starts_, node_;
  std::vector<SegmentSet::Node> nodes_;
};

}  // namespace

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner)
    : origin_(seeds.scale() * (0.5 * side)) {
  thread_local EdgeBuilder builder;
  segments_ = builder.build(seeds, corner, origin_);
}

std::vector<FoamEdge> EdgeBrick::edges() const {
  std::vector<FoamEdge> edges;
  for (size_t i = 0; i < segments_.count(); ++i) {
    const FloatSegment s = segments_.at(i);
    edges.push_back(
        {origin_ + Vec3{s.a[0], s.a[1], s.a[2]}, origin_ + Vec3{s.b[0], s.b[1], s.b[2]}});
  }
  return edges;
}

}  // namespace msq
