// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/ray_brick.h"

#include <algorithm>
#include <cmath>

#include "base/borrowed.h"
#include "structure/foam/edges/edge_builder.h"
#include "structure/foam/rays/cells_near_edges.h"

namespace msq {

namespace {

/// Slack for roundings in single precision, coordinates below 16.
constexpr double slack = 1e-5;

/// Memory for a brick's edges.
struct EdgeWorkspace {
  EdgeBuilder builder;
  std::vector<uint16_t> numbers;  // of nodes, or no_number
  std::vector<std::array<float, 3>> nodes;

  size_t bytes() const { return builder.bytes(); }
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
  const Borrowed<EdgeWorkspace> workspace;
  auto& [builder, numbers, nodes] = *workspace;
  constexpr uint16_t no_number = UINT16_MAX;
  builder.build(seeds, corner, side, true);
  numbers.assign(builder.vertex_count(), no_number);
  nodes.resize(builder.vertex_count() + 1);
  uint16_t count = 0;
  edges_.resize(builder.ends().size());
  for (size_t e = 0; e < edges_.size(); ++e) {
    for (size_t end = 0; end < 2; ++end) {
      // Without a branch: whether a vertex is new is unpredictable.
      const uint32_t vertex = builder.ends()[e][end];
      const Vec3 p = builder.vertex(vertex);
      nodes[count] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
      const uint16_t known = numbers[vertex];
      const uint16_t number = known == no_number ? count : known;
      count = static_cast<uint16_t>(count + (known == no_number));
      numbers[vertex] = edges_[e].ends[end] = number;
    }
    edges_[e].seeds = pack_seeds(builder.block(), builder.seeds()[e]);
  }
  nodes_.assign(nodes.begin(), nodes.begin() + count);
  list_edges(seeds, radius);
  owning_.fill(0xff);
  if (*std::max_element(reach_.begin(), reach_.end()) <= side / 2)
    owning_ = find_owning_bricks(builder.block(), seeds.scale(), radius + ray_list_margin + slack);
}

uint32_t RayBrick::pack_seeds(const BrickSeeds& block, const std::array<uint32_t, 3>& triple) {
  if (triple[0] == triple[1]) return no_seeds;
  const std::array<int, 3>& own = block.cell(triple[0]);
  auto packed = static_cast<uint32_t>((own[2] * side + own[1]) * side + own[0]);
  int shift = 6;
  // In the order of cells; the owner comes before both.
  for (const uint32_t seed : {std::min(triple[1], triple[2]), std::max(triple[1], triple[2])}) {
    const std::array<int, 3>& cell = block.cell(seed);
    for (size_t axis = 0; axis < 3; ++axis, shift += 4) {
      const int apart = cell[axis] - own[axis];
      if (std::abs(apart) > max_apart) return no_seeds;
      packed |= static_cast<uint32_t>(apart + max_apart) << shift;
    }
  }
  return packed;
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
    box.first[axis] = -reach_[axis];
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
