// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/ray_brick.h"

#include <algorithm>
#include <cmath>

#include "base/borrowed.h"
#include "structure/foam/edges/edge_builder.h"
#include "structure/foam/edges/facet_walk.h"
#include "structure/foam/rays/cells_near_edges.h"

namespace msq {

namespace {

/// Slack for roundings in single precision, coordinates below 16.
constexpr double slack = 1e-5;

/// Numbers of the vertices of edges, in the order in which edges name them. Memory for one brick
/// after another.
class NodeNumbers {
 public:
  void clear(size_t vertices) {
    numbers_.assign(vertices, no_number);
    vertices_.resize(vertices + 1);
    count_ = 0;
  }
  /// Without a branch: whether a vertex is new is unpredictable.
  uint16_t take(uint32_t vertex) {
    vertices_[count_] = vertex;
    const uint16_t known = numbers_[vertex];
    const uint16_t number = known == no_number ? count_ : known;
    count_ = static_cast<uint16_t>(count_ + (known == no_number));
    return numbers_[vertex] = number;
  }
  std::span<const uint32_t> vertices() const { return {vertices_.data(), count_}; }

 private:
  static constexpr uint16_t no_number = UINT16_MAX;
  std::vector<uint16_t> numbers_;
  std::vector<uint32_t> vertices_;
  uint16_t count_ = 0;
};

/// Memory for the lists of cells.
struct ListWorkspace {
  EdgeEnds ends;
  std::vector<NearCell> near;
  std::vector<uint32_t> next;
};

}  // namespace

std::array<int, 3> RayBrick::reach(const FoamSeeds& seeds, double radius) {
  // Owners are within the empty radius of all points of their edges.
  const double out = radius + ray_list_margin + slack + seeds.empty_radius();
  const Vec3 scale = seeds.scale();
  return {static_cast<int>(std::ceil(out / scale.x)), static_cast<int>(std::ceil(out / scale.y)),
          static_cast<int>(std::ceil(out / scale.z))};
}

bool RayBrick::fits(const FoamSeeds& seeds) {
  const Vec3 scale = seeds.scale();
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = std::ceil(2 * seeds.empty_radius() / scale[axis]);
    if (half > 100) return false;
    count *= side + 2 * half;
  }
  return count < 65536;
}

RayBrick::RayBrick(const FoamSeeds& seeds, CellIndex corner, double radius)
    : corner_(corner), reach_(reach(seeds, radius)) {
  if (FacetWalk::suits(seeds)) {
    const Borrowed<FacetWalk> walk;
    if (walk->build(seeds, corner, side)) {
      build_by_facets(*walk);
      list_edges(seeds, radius);
      return;
    }
  }
  const Borrowed<EdgeBuilder> builder;
  builder->build(seeds, corner, side, true);
  build_by_cells(*builder, seeds.scale());
  list_edges(seeds, radius);
}

void RayBrick::build_by_facets(const FacetWalk& walk) {
  const Borrowed<NodeNumbers> numbers;
  numbers->clear(walk.vertex_count());
  edges_.resize(walk.count());
  size_t e = 0;
  walk.for_each_edge([&](const FacetWalk::Edge& edge) {
    for (size_t end = 0; end < 2; ++end) edges_[e].ends[end] = numbers->take(edge.ends[end]);
    edges_[e++].seeds = pack_seeds(edge.owner, edge.others);
  });
  nodes_.reserve(numbers->vertices().size());
  for (const uint32_t vertex : numbers->vertices()) {
    const float(&p)[4] = walk.vertex(vertex);
    nodes_.push_back({p[0], p[1], p[2]});
  }
}

void RayBrick::build_by_cells(const EdgeBuilder& builder, Vec3 scale) {
  const Borrowed<NodeNumbers> numbers;
  numbers->clear(builder.vertex_count());
  edges_.resize(builder.ends().size());
  for (size_t e = 0; e < edges_.size(); ++e) {
    for (size_t end = 0; end < 2; ++end)
      edges_[e].ends[end] = numbers->take(builder.ends()[e][end]);
    edges_[e].seeds = pack_seeds(builder.block(), builder.seeds()[e]);
  }
  const Vec3 origin = scale * (0.5 * side);
  nodes_.reserve(numbers->vertices().size());
  for (const uint32_t vertex : numbers->vertices()) {
    const Vec3 p = builder.vertex(vertex) - origin;
    nodes_.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
}

uint8_t RayBrick::owning(const FoamSeeds& seeds, double radius, int x, int y, int z) const {
  constexpr int half = side / 2;
  if (*std::max_element(reach_.begin(), reach_.end()) > half) return 0xff;
  const auto bits_of = [](bool i, bool j, bool k) {
    return static_cast<unsigned>(i) | static_cast<unsigned>(j) << 1 | static_cast<unsigned>(k) << 2;
  };
  const unsigned eighth = bits_of(x >= half, y >= half, z >= half);
  // Threads that come at once find the same.
  uint64_t found = owning_[eighth].load(std::memory_order_relaxed);
  if (found == 0) {
    found = find_owning_bricks(seeds, corner_, eighth, radius + ray_list_margin + slack);
    owning_[eighth].store(found, std::memory_order_relaxed);
  }
  return static_cast<uint8_t>(found >> 8 * bits_of(x & 1, y & 1, z & 1));
}

uint32_t RayBrick::pack_seeds(const int (&owner)[3], const int (&others)[2][3]) {
  auto packed = static_cast<uint32_t>((owner[2] * side + owner[1]) * side + owner[0]);
  int shift = 6;
  for (const int(&other)[3] : others)
    for (size_t axis = 0; axis < 3; ++axis, shift += 4)
      packed |= static_cast<uint32_t>(other[axis] + max_apart) << shift;
  return packed;
}

uint32_t RayBrick::pack_seeds(const BrickSeeds& block, const std::array<uint32_t, 3>& triple) {
  if (triple[0] == triple[1]) return no_seeds;
  const std::array<int, 3>& own = block.cell(triple[0]);
  // In the order of cells; the owner comes before both.
  const uint32_t seeds[2] = {std::min(triple[1], triple[2]), std::max(triple[1], triple[2])};
  int others[2][3];
  for (size_t i = 0; i < 2; ++i)
    for (size_t axis = 0; axis < 3; ++axis) {
      others[i][axis] = block.cell(seeds[i])[axis] - own[axis];
      if (std::abs(others[i][axis]) > max_apart) return no_seeds;
    }
  return pack_seeds({own[0], own[1], own[2]}, others);
}

std::array<CellIndex, 3> RayBrick::seeds(size_t edge) const {
  uint32_t packed = edges_[edge].seeds;
  const auto take = [&](int bits) {
    const auto value = static_cast<int>(packed & ((uint32_t{1} << bits) - 1));
    packed >>= bits;
    return value;
  };
  const int x = take(2), y = take(2), z = take(2);
  const CellIndex own{corner_.x + x, corner_.y + y, corner_.z + z};
  std::array<CellIndex, 3> cells{own, own, own};
  for (size_t i = 1; i < 3; ++i) {
    cells[i].x += take(4) - max_apart;
    cells[i].y += take(4) - max_apart;
    cells[i].z += take(4) - max_apart;
  }
  return cells;
}

void RayBrick::list_edges(const FoamSeeds& seeds, double radius) {
  const Borrowed<ListWorkspace> workspace;
  auto& [ends, near, next] = *workspace;
  ends.resize(edges_.size());
  for (size_t e = 0; e < edges_.size(); ++e) ends.set(e, end(e, 0), end(e, 1));
  CellBox box;
  size_t cells = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.size[axis] = static_cast<float>(seeds.scale()[static_cast<int>(axis)]);
    box.first[axis] = -side / 2 - reach_[axis];
    box.count[axis] = side + 2 * reach_[axis];
    cells *= static_cast<size_t>(box.count[axis]);
  }
  find_cells_near_edges(ends, box, static_cast<float>(radius + ray_list_margin + slack), near);
  starts_.assign(cells + 1, 0);
  for (const NearCell& place : near) ++starts_[place.cell + 1];
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  listed_.resize(near.size());
  next = starts_;
  for (const NearCell& place : near)
    listed_[next[place.cell]++] = static_cast<uint16_t>(place.edge);
}

}  // namespace msq
