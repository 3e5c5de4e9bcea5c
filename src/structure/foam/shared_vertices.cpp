// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/shared_vertices.h"

#include <algorithm>

namespace msq {

void SharedVertices::reset(const SeedBlock& block) {
  vertices_.clear();
  const size_t side = static_cast<size_t>(block.side()), count = side * side * side;
  number_.assign(block.positions().size(), not_in_brick);
  plane_.resize(block.positions().size());
  lists_.resize(count);
  size_t number = 0;
  for (int z = 0; z < block.side(); ++z)
    for (int y = 0; y < block.side(); ++y)
      for (int x = 0; x < block.side(); ++x) {
        lists_[number].count = 0;
        number_[block.index(x, y, z)] = static_cast<uint16_t>(number++);
      }
}

double SharedVertices::needed(const SeedBlock& block, size_t own) const {
  const Vec3 seed = block.position(own);
  const List& list = lists_[number_[own]];
  double most = 0;
  for (uint32_t i = 0; i < list.count; ++i) {
    const Vec3 p = vertices_[list.vertices[i] >> 2].position - seed;
    most = std::max(most, dot(p, p));
  }
  return 4 * most * (1 + 1e-6);  // rounding
}

void SharedVertices::give(const SeedBlock& block, size_t own, VoronoiCell& cell) {
  const List& list = lists_[number_[own]];
  if (list.count == 0) return;
  const Vec3 seed = block.position(own);
  const VoronoiCell::Planes& planes = cell.planes();
  for (uint32_t i = 0; i < planes.count; ++i) plane_[planes.seed[i]] = static_cast<uint8_t>(i);
  for (uint32_t i = 0; i < list.count; ++i) {
    const Vertex& vertex = vertices_[list.vertices[i] >> 2];
    // Seen from one of the last three, the others follow one another the other way round.
    constexpr uint8_t others[3][2] = {{3, 2}, {1, 3}, {2, 1}};
    const uint8_t* other = others[list.vertices[i] & 3];
    cell.add_vertex(plane_[vertex.seeds[0]], plane_[vertex.seeds[other[0]]],
                    plane_[vertex.seeds[other[1]]], vertex.position - seed);
  }
}

void SharedVertices::take(const SeedBlock& block, size_t own, uint32_t before,
                          const VoronoiCell& cell) {
  const Vec3 seed = block.position(own);
  const uint32_t* seeds = cell.planes().seed;
  cell.for_each_new_vertex([&](const uint8_t* plane, Vec3 p) {
    const uint32_t number = static_cast<uint32_t>(vertices_.size());
    const uint32_t a = seeds[plane[0]], b = seeds[plane[1]], c = seeds[plane[2]];
    vertices_.push_back({seed + p, {static_cast<uint32_t>(own), a, b, c}});
    for (uint32_t i = 0; i < 3; ++i) {
      const uint16_t at = number_[seeds[plane[i]]];
      if (plane[i] < before || at == not_in_brick) continue;
      // A list that is full leaves the vertex to be found again.
      List& list = lists_[at];
      if (list.count < List::most) list.vertices[list.count++] = number << 2 | i;
    }
  });
}

}  // namespace msq
