// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeded_edges.h"

#include <algorithm>
#include <cmath>

#include "structure/foam/edge_builder.h"

namespace msq {

namespace {

/// Room for roundings in single precision, coordinates below 16.
constexpr double slack = 1e-5;

/// Squared distance between a point and a segment.
float distance_squared(const float (&p)[3], const std::array<float, 3>& a, const float (&ab)[3]) {
  float across = 0, length = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    across += (p[axis] - a[axis]) * ab[axis];
    length += ab[axis] * ab[axis];
  }
  const float s = std::clamp(across / std::max(length, 1e-30f), 0.0f, 1.0f);
  float squared = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const float d = p[axis] - a[axis] - s * ab[axis];
    squared += d * d;
  }
  return squared;
}

/// Rounds down; std::floor is a call where the processor at hand is not known.
int floor_of(float x) {
  return static_cast<int>(x + 128) - 128;
}

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
  thread_local std::vector<uint16_t> numbers;  // of nodes; 0: none yet, then from 1 on
  builder.build(seeds, corner, side, true);
  numbers.assign(builder.vertex_count(), 0);
  const size_t count = builder.ends().size();
  nodes_.reserve(count);
  edges_.resize(count);
  for (size_t e = 0; e < count; ++e) {
    for (size_t end = 0; end < 2; ++end) {
      const uint32_t vertex = builder.ends()[e][end];
      if (numbers[vertex] == 0) {
        const Vec3 p = builder.vertex(vertex);
        nodes_.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        numbers[vertex] = static_cast<uint16_t>(nodes_.size());
      }
      edges_[e].ends[end] = static_cast<uint16_t>(numbers[vertex] - 1);
    }
    const std::array<uint32_t, 3>& triple = builder.seeds()[e];
    const std::array<int, 3> own = builder.block().cell(triple[0]);
    edges_[e].owner = static_cast<uint8_t>((own[2] * side + own[1]) * side + own[0]);
    for (size_t i = 0; i < 2; ++i) {
      const std::array<int, 3> cell = builder.block().cell(triple[i + 1]);
      for (size_t axis = 0; axis < 3; ++axis)
        edges_[e].others[i][axis] = static_cast<int8_t>(cell[axis] - own[axis]);
    }
    if (triple[0] == triple[1]) {
      edges_[e].others[0][0] = no_seed;
      continue;
    }
    // The owner comes before both.
    const auto place = [](const Offset& o) { return std::array<int8_t, 3>{o[2], o[1], o[0]}; };
    if (place(edges_[e].others[1]) < place(edges_[e].others[0]))
      std::swap(edges_[e].others[0], edges_[e].others[1]);
  }
  nodes_.shrink_to_fit();
  list_edges(seeds, radius);
}

std::array<CellIndex, 3> SeededEdges::seeds(size_t edge) const {
  const Edge& e = edges_[edge];
  const CellIndex own{corner_.x + e.owner % side, corner_.y + e.owner / side % side,
                      corner_.z + e.owner / side / side};
  std::array<CellIndex, 3> cells{own, own, own};
  for (size_t i = 0; i < 2; ++i) {
    cells[i + 1].x += e.others[i][0];
    cells[i + 1].y += e.others[i][1];
    cells[i + 1].z += e.others[i][2];
  }
  return cells;
}

void SeededEdges::list_edges(const FoamSeeds& seeds, double radius) {
  struct Place {
    uint32_t bucket;
    uint16_t edge;
  };
  thread_local std::vector<Place> places;
  places.clear();
  const Vec3 scale = seeds.scale();
  const float size[3] = {static_cast<float>(scale.x), static_cast<float>(scale.y),
                         static_cast<float>(scale.z)};
  const float to_cell[3] = {1 / size[0], 1 / size[1], 1 / size[2]};
  const float grown = static_cast<float>(radius + ray_list_margin + slack);
  // A point within the margin of a cell along each axis, and the axis of its strut from there.
  const float most = static_cast<float>(0.5 * length(scale) + radius + 2 * ray_list_margin + slack);
  const int across[3] = {side + 2 * reach_[0], side + 2 * reach_[1], side + 2 * reach_[2]};
  for (size_t e = 0; e < edges_.size(); ++e) {
    const std::array<float, 3>&a = end(e, 0), &b = end(e, 1);
    int first[3], last[3];
    float ab[3];
    bool is_one = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto [least, greatest] = std::minmax(a[axis], b[axis]);
      first[axis] = std::max(floor_of((least - grown) * to_cell[axis]), -reach_[axis]);
      last[axis] = std::min(floor_of((greatest + grown) * to_cell[axis]), side - 1 + reach_[axis]);
      ab[axis] = b[axis] - a[axis];
      is_one &= first[axis] == last[axis];
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const float middle[3] = {(static_cast<float>(x) + 0.5f) * size[0],
                                   (static_cast<float>(y) + 0.5f) * size[1],
                                   (static_cast<float>(z) + 0.5f) * size[2]};
          if (!is_one && distance_squared(middle, a, ab) > most * most) continue;
          const int bucket =
              ((z + reach_[2]) * across[1] + y + reach_[1]) * across[0] + x + reach_[0];
          places.push_back({static_cast<uint32_t>(bucket), static_cast<uint16_t>(e)});
        }
  }
  starts_.assign(static_cast<size_t>(across[0] * across[1] * across[2]) + 1, 0);
  for (const Place& place : places) ++starts_[place.bucket + 1];
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  listed_.resize(places.size());
  thread_local std::vector<uint32_t> next;
  next = starts_;
  for (const Place& place : places) listed_[next[place.bucket]++] = place.edge;
}

}  // namespace msq
