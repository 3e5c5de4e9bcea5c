// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/shared_vertices.h"

#include <algorithm>

namespace msq {

void SharedVertices::reset(const BrickSeeds& block) {
  vertices_.clear();
  const size_t side = static_cast<size_t>(block.side()), count = side * side * side;
  number_.assign(block.positions().size(), static_cast<uint16_t>(count));
  plane_.resize(block.positions().size());
  lists_.resize(count + 1);
  for (List& list : lists_) {
    list.max_squared = 0;
    list.count = 0;
  }
  size_t number = 0;
  for (int z = 0; z < block.side(); ++z)
    for (int y = 0; y < block.side(); ++y)
      for (int x = 0; x < block.side(); ++x) {
        number_[block.index(x, y, z)] = static_cast<uint16_t>(number++);
      }
}

void SharedVertices::give(const BrickSeeds& block, size_t own, VoronoiCell& cell) {
  const List& list = lists_[number_[own]];
  numbers_.clear();
  if (list.count == 0) return;
  const Vec3 seed = block.position(own);
  const VoronoiCell::Planes& planes = cell.planes();
  for (uint32_t i = 0; i < planes.count; ++i) plane_[planes.seed[i]] = static_cast<uint8_t>(i);
  for (uint32_t i = 0; i < list.count; ++i) {
    const uint32_t number = list.vertices[i] >> 2;
    const Vertex& vertex = vertices_[number];
    // As seen from one of the last three, the others are in the opposite order.
    constexpr uint8_t others[3][2] = {{3, 2}, {1, 3}, {2, 1}};
    const uint8_t* other = others[list.vertices[i] & 3];
    cell.add_vertex(plane_[vertex.seeds[0]], plane_[vertex.seeds[other[0]]],
                    plane_[vertex.seeds[other[1]]], vertex.position - seed);
    numbers_.push_back(number);
  }
}

void SharedVertices::take(const BrickSeeds& block, size_t own, uint32_t before,
                          const VoronoiCell& cell) {
  const Vec3 seed = block.position(own);
  const uint32_t* seeds = cell.planes().seed;
  // Vertices that are found anew may belong to other cells, too. If shared, they would come twice.
  const bool is_shared = !cell.found_anew();
  if (!is_shared) numbers_.clear();
  cell.for_each_new_vertex([&](const uint8_t* plane, Vec3 p) {
    const uint32_t number = static_cast<uint32_t>(vertices_.size());
    const uint32_t a = seeds[plane[0]], b = seeds[plane[1]], c = seeds[plane[2]];
    vertices_.push_back({seed + p, {static_cast<uint32_t>(own), a, b, c}});
    numbers_.push_back(number);
    if (!is_shared) return;
    const double squared = dot(p, p);  // equal for all four seeds
    // Without a branch: which seeds come later is unpredictable. The last list takes those of seeds
    // that come earlier or are in other bricks. If a list is full, the vertex is found again.
    for (uint32_t i = 0; i < 3; ++i) {
      List& list = plane[i] < before ? lists_.back() : lists_[number_[seeds[plane[i]]]];
      list.vertices[list.count] = number << 2 | i;
      list.count += list.count < List::most;
      list.max_squared = std::max(list.max_squared, squared);
    }
  });
}

uint32_t SharedVertices::take(Vec3 position) {
  vertices_.push_back({position, {}});
  return static_cast<uint32_t>(vertices_.size() - 1);
}

}  // namespace msq
