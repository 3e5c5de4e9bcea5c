// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeded_edges.h"

#include <algorithm>
#include <cmath>

#include "structure/foam/cells_near_edges.h"
#include "structure/foam/edge_builder.h"

namespace msq {

namespace {

/// Room for roundings in single precision, coordinates below 16.
constexpr double slack = 1e-5;

}  // namespace

std::array<int, 3> SeededEdges::reach(const FoamSeeds& seeds, double radius) {
  // Owners are within the empty radius of all points of their edges.
  const double out = radius + ray_list_margin + slack + seeds.empty_radius();
  const Vec3 scale = seeds.scale();
  return {static_cast<int>(std::ceil(out / scale.x)), static_cast<int>(std::ceil(out / scale.y)),
          static_cast<int>(std::ceil(out / scale.z))};
}

bool SeededEdges::fits(const FoamSeeds& seeds) {
  const Vec3 scale = seeds.scale();
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = std::ceil(2 * seeds.empty_radius() / scale[axis]);
    if (half > 100) return false;
    count *= side + 2 * half;
  }
  return count < 65536;
}

SeededEdges::SeededEdges(const FoamSeeds& seeds, CellIndex corner, double radius)
    : corner_(corner), reach_(reach(seeds, radius)) {
  thread_local EdgeBuilder builder;
  thread_local std::vector<uint16_t> numbers;  // of nodes, or no_number
  constexpr uint16_t no_number = UINT16_MAX;
  thread_local std::vector<std::array<float, 3>> nodes;
  builder.build(seeds, corner, side, true);
  numbers.assign(builder.vertex_count(), no_number);
  nodes.resize(builder.vertex_count() + 1);
  uint16_t count = 0;
  edges_.resize(builder.ends().size());
  for (size_t e = 0; e < edges_.size(); ++e) {
    for (size_t end = 0; end < 2; ++end) {
      // Without a branch: whether a vertex is new is a coin toss.
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

uint32_t SeededEdges::pack_seeds(const SeedBlock& block, const std::array<uint32_t, 3>& triple) {
  if (triple[0] == triple[1]) return no_seeds;
  const std::array<int, 3>& own = block.cell(triple[0]);
  auto packed = static_cast<uint32_t>((own[2] * side + own[1]) * side + own[0]);
  int shift = 6;
  // In the order of cells; the owner comes before both.
  for (const uint32_t seed : {std::min(triple[1], triple[2]), std::max(triple[1], triple[2])}) {
    const std::array<int, 3>& cell = block.cell(seed);
    for (size_t axis = 0; axis < 3; ++axis, shift += 4) {
      const int apart = cell[axis] - own[axis];
      if (std::abs(apart) > most_apart) return no_seeds;
      packed |= static_cast<uint32_t>(apart + most_apart) << shift;
    }
  }
  return packed;
}

std::array<CellIndex, 3> SeededEdges::seeds(size_t edge) const {
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
    cells[i].x += take(4) - most_apart;
    cells[i].y += take(4) - most_apart;
    cells[i].z += take(4) - most_apart;
  }
  return cells;
}

void SeededEdges::list_edges(const FoamSeeds& seeds, double radius) {
  thread_local EdgeEnds ends;
  thread_local std::vector<NearCell> near;
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
  thread_local std::vector<uint32_t> next;
  next = starts_;
  for (const NearCell& place : near)
    listed_[next[place.cell]++] = static_cast<uint16_t>(place.edge);
}

}  // namespace msq
