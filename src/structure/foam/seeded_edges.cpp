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
float distance_squared(const float (&p)[3], const float (&a)[3], const float (&ab)[3]) {
  float across = 0, length = 0;
  for (int axis = 0; axis < 3; ++axis) {
    across += (p[axis] - a[axis]) * ab[axis];
    length += ab[axis] * ab[axis];
  }
  const float s = std::clamp(across / std::max(length, 1e-30f), 0.0f, 1.0f);
  float squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
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

SeededEdges::SeededEdges(const FoamSeeds& seeds, CellIndex corner, double radius)
    : reach_(reach(seeds, radius)) {
  thread_local EdgeBuilder builder;
  thread_local std::vector<SegmentSet::Node> nodes;
  builder.build(seeds, corner, side, true);
  nodes.resize(builder.vertex_count());
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const Vec3 p = builder.vertex(i);
    nodes[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  segments_ = SegmentSet(nodes, builder.ends(), builder.starts());
  seeds_.reserve(builder.seeds().size());
  for (const std::array<uint32_t, 3>& triple : builder.seeds()) {
    std::array<Offset, 3>& offsets = seeds_.emplace_back();
    for (size_t i = 0; i < 3; ++i) {
      const std::array<int, 3> cell = builder.block().cell(triple[i]);
      offsets[i] = {static_cast<int8_t>(cell[0]), static_cast<int8_t>(cell[1]),
                    static_cast<int8_t>(cell[2])};
    }
  }
  list_edges(seeds, radius);
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
  for (size_t e = 0; e < segments_.count(); ++e) {
    const FloatSegment s = segments_.at(e);
    int begin[3], end[3];
    float ab[3];
    bool is_one = true;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, greatest] = std::minmax(s.a[axis], s.b[axis]);
      begin[axis] =
          std::max(floor_of((least - grown) * to_cell[axis]), -reach_[static_cast<size_t>(axis)]);
      end[axis] = std::min(floor_of((greatest + grown) * to_cell[axis]),
                           side - 1 + reach_[static_cast<size_t>(axis)]);
      ab[axis] = s.b[axis] - s.a[axis];
      is_one &= begin[axis] == end[axis];
    }
    for (int z = begin[2]; z <= end[2]; ++z)
      for (int y = begin[1]; y <= end[1]; ++y)
        for (int x = begin[0]; x <= end[0]; ++x) {
          const float middle[3] = {(static_cast<float>(x) + 0.5f) * size[0],
                                   (static_cast<float>(y) + 0.5f) * size[1],
                                   (static_cast<float>(z) + 0.5f) * size[2]};
          if (!is_one && distance_squared(middle, s.a, ab) > most * most) continue;
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
