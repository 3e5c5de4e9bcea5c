// SPDX-License-Identifier: Apache-2.0
// Each seed's Voronoi cell is found by a walk (voronoi_cell.h) among the seeds within some distance D
// of it. It is the true cell if its farthest vertex is within D / 2: a seed farther than D is farther
// than twice any vertex, and cuts nothing. If not, D grows, up to twice the empty radius, beyond
// which no seed can matter. Where the walk fails (seeds on one sphere, low jitter), every pair of
// neighbours is tried by the definition itself (edge_line.h), which needs no graph.
#include "structure/foam/edges.h"

#include <algorithm>

#include "structure/foam/edge_line.h"
#include "structure/foam/voronoi_cell.h"

namespace msq {

namespace {

/// Seeds of a brick and all around it that can matter to its seeds.
class SeedBlock {
 public:
  SeedBlock(const FoamSeeds& seeds, CellIndex corner) {
    const double reach = 2 * seeds.empty_radius();
    int size[3];
    for (int axis = 0; axis < 3; ++axis) {
      // A seed within `reach` of one in this cell is at most that many cells away.
      halo_[axis] = static_cast<int>(std::ceil(reach / seeds.scale()[axis]));
      size[axis] = EdgeBrick::side + 2 * halo_[axis];
    }
    stride_y_ = size[0];
    stride_z_ = static_cast<ptrdiff_t>(size[0]) * size[1];
    positions_.reserve(static_cast<size_t>(stride_z_) * size[2]);
    for (int z = -halo_[2]; z < EdgeBrick::side + halo_[2]; ++z)
      for (int y = -halo_[1]; y < EdgeBrick::side + halo_[1]; ++y)
        for (int x = -halo_[0]; x < EdgeBrick::side + halo_[0]; ++x)
          positions_.push_back(seeds.at(corner, x, y, z));
  }

  int halo(int axis) const { return halo_[axis]; }
  ptrdiff_t index(int x, int y, int z) const {
    return (z + halo_[2]) * stride_z_ + (y + halo_[1]) * stride_y_ + (x + halo_[0]);
  }
  Vec3 position(ptrdiff_t index) const { return positions_[static_cast<size_t>(index)]; }

 private:
  int halo_[3];
  ptrdiff_t stride_y_, stride_z_;
  std::vector<Vec3> positions_;
};

/// Cells around a cell, by the least distance that seeds in the two can have.
struct Offset {
  int x, y, z;
  ptrdiff_t index;  // in the seed block
  double least_squared;
};

std::vector<Offset> offsets_by_distance(const SeedBlock& block, Vec3 scale) {
  std::vector<Offset> offsets;
  for (int z = -block.halo(2); z <= block.halo(2); ++z)
    for (int y = -block.halo(1); y <= block.halo(1); ++y)
      for (int x = -block.halo(0); x <= block.halo(0); ++x) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 gap = Vec3{std::max(0.0, std::abs(x) - 1.0), std::max(0.0, std::abs(y) - 1.0),
                              std::max(0.0, std::abs(z) - 1.0)} *
                         scale;
        offsets.push_back({x, y, z, block.index(x, y, z) - block.index(0, 0, 0), dot(gap, gap)});
      }
  std::stable_sort(offsets.begin(), offsets.end(), [](const Offset& a, const Offset& b) {
    return a.least_squared < b.least_squared;
  });
  return offsets;
}

/// A seed near the one whose cell is built.
struct Neighbour {
  Vec3 position;  // relative to it
  bool after;     // in the order of cells
};

/// A list of neighbours with D^2 at least this holds most cells (cube cells: 97 of 100).
constexpr double first_distance_squared = 4.75;

class EdgeBuilder {
 public:
  EdgeBuilder(const FoamSeeds& seeds, CellIndex corner, std::vector<FoamEdge>& edges)
      : block_(seeds, corner),
        offsets_(offsets_by_distance(block_, seeds.scale())),
        most_squared_(4 * seeds.empty_radius() * seeds.empty_radius()),
        edges_(edges) {}

  void add_owned_edges(int x, int y, int z) {
    const ptrdiff_t own = block_.index(x, y, z);
    const Vec3 seed = block_.position(own);
    for (double d2 = std::min(first_distance_squared, most_squared_);;) {
      gather(own, d2);
      if (neighbours_.size() > VoronoiCell::most_planes || !walk()) break;
      // 1e-9: room for the rounding of vertices.
      if (d2 >= most_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
        cell_.for_each_edge(
            [&](uint32_t a, uint32_t b) { return neighbours_[a].after && neighbours_[b].after; },
            [&](const VoronoiCell::Edge& edge) {
              add(seed + edge.from, seed + edge.to);
            });
        return;
      }
      d2 = std::min(most_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
    }
    gather(own, most_squared_);
    add_by_definition(seed);
  }

 private:
  void add(Vec3 a, Vec3 b) {
    edges_.push_back({{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)},
                      {static_cast<float>(b.x), static_cast<float>(b.y), static_cast<float>(b.z)}});
  }

  void gather(ptrdiff_t own, double distance_squared) {
    neighbours_.clear();
    const Vec3 seed = block_.position(own);
    for (const Offset& offset : offsets_) {
      if (offset.least_squared > distance_squared) break;
      const Vec3 d = block_.position(own + offset.index) - seed;
      if (dot(d, d) > distance_squared) continue;
      const bool after = offset.z != 0 ? offset.z > 0 : offset.y != 0 ? offset.y > 0 : offset.x > 0;
      neighbours_.push_back({d, after});
    }
  }

  bool walk() {
    cell_.clear();
    for (const Neighbour& n : neighbours_) cell_.add(n.position);
    return cell_.walk();
  }

  /// Every pair of later neighbours, cut by all others.
  void add_by_definition(Vec3 seed) {
    std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& a, const Neighbour& b) {
      return dot(a.position, a.position) < dot(b.position, b.position);
    });
    for (size_t i = 0; i < neighbours_.size(); ++i) {
      if (!neighbours_[i].after) continue;
      for (size_t j = i + 1; j < neighbours_.size(); ++j) {
        if (!neighbours_[j].after) continue;
        const EdgeLine line(Vec3{}, neighbours_[i].position, neighbours_[j].position);
        if (!line.exists()) continue;
        LineInterval part{-1e300, 1e300};
        for (size_t k = 0; k < neighbours_.size() && line.holds(part); ++k)
          if (k != i && k != j) line.cut(neighbours_[k].position, part);
        if (line.holds(part)) add(seed + line.at(part.low), seed + line.at(part.high));
      }
    }
  }

  SeedBlock block_;
  std::vector<Offset> offsets_;
  double most_squared_;
  std::vector<Neighbour> neighbours_;
  VoronoiCell cell_;
  std::vector<FoamEdge>& edges_;
};

}  // namespace

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner) {
  edges_.reserve(side * side * side * 15);
  groups_.reserve(side * side * side);
  EdgeBuilder builder(seeds, corner, edges_);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        Group group{static_cast<uint32_t>(edges_.size()), 0, {1e30f, 1e30f, 1e30f},
                    {-1e30f, -1e30f, -1e30f}};
        builder.add_owned_edges(x, y, z);
        group.last = static_cast<uint32_t>(edges_.size());
        for (uint32_t i = group.first; i < group.last; ++i)
          for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] = std::minmax(edges_[i].a[axis], edges_[i].b[axis]);
            group.low[axis] = std::min(group.low[axis], low);
            group.high[axis] = std::max(group.high[axis], high);
          }
        groups_.push_back(group);
      }
  edges_.shrink_to_fit();
}

}  // namespace msq
