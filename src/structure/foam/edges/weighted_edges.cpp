// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/weighted_edges.h"

#include "base/job.h"
#include "structure/foam/point/weighted_line.h"

namespace msq {

void WeightedEdges::build(const FoamSeeds& seeds, CellIndex corner, int side) {
  cells_.move_to(seeds, corner, side);
  vertices_.clear();
  ends_.clear();
  starts_.clear();
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      check_cancelled();
      starts_.push_back(static_cast<uint32_t>(ends_.size()));
      for (int x = 0; x < side; ++x) {
        const size_t own = cells_.block().index(x, y, z);
        const WeightedCells::Found found = cells_.find(own);
        if (found == WeightedCells::Found::walked) add_walked(own);
        if (found == WeightedCells::Found::cell) add_cell(own);
        if (found == WeightedCells::Found::unknown) add_by_definition(own);
      }
    }
}

void WeightedEdges::add_walked(size_t own) {
  const VoronoiCell& cell = cells_.walked();
  const Vec3 seed = cells_.block().position(own);
  const uint32_t first = static_cast<uint32_t>(vertices_.size());
  for (size_t v = 0; v < cell.vertex_count(); ++v) vertices_.push_back(seed + cell.vertex(v));
  cell.for_each_edge(cells_.before(), [&](size_t from, size_t to, uint32_t, uint32_t) {
    ends_.push_back({first + static_cast<uint32_t>(from), first + static_cast<uint32_t>(to)});
  });
}

/// The edges between two planes of seeds that come after the own one.
void WeightedEdges::add_cell(size_t own) {
  constexpr uint32_t none = ~uint32_t{0};
  const Vec3 seed = cells_.block().position(own);
  const std::vector<ClippedCell::Vertex>& vertices = cells_.clipped().vertices();
  const auto is_after = [&](uint32_t plane) {
    return plane >= ClippedCell::first_neighbour &&
           cells_.neighbours()[plane - ClippedCell::first_neighbour].seed > own;
  };
  numbers_.assign(vertices.size(), none);
  const auto number = [&](uint32_t v) {
    if (numbers_[v] == none) numbers_[v] = take(seed + vertices[v].position);
    return numbers_[v];
  };
  for (uint32_t v = 0; v < vertices.size(); ++v)
    for (int i = 0; vertices[v].is_there && i < 3; ++i) {
      const uint32_t a = vertices[v].plane[i], b = vertices[v].plane[(i + 1) % 3];
      if (a < b && is_after(a) && is_after(b))
        ends_.push_back({number(v), number(vertices[v].next[i])});
    }
}

/// Every pair of later neighbours, cut by all others.
void WeightedEdges::add_by_definition(size_t own) {
  const Vec3 seed = cells_.block().position(own);
  const std::vector<WeightedCells::Neighbour>& neighbours = cells_.neighbours();
  const auto lifted = [&](size_t i) {
    return LiftedSeed{neighbours[i].position, cells_.lift(neighbours[i].seed)};
  };
  const size_t count = neighbours.size();
  for (size_t i = 0; i < count; ++i) {
    if (neighbours[i].seed < own) continue;
    check_cancelled();
    for (size_t j = i + 1; j < count; ++j) {
      if (neighbours[j].seed < own) continue;
      const WeightedLine line({{}, cells_.lift(own)}, lifted(i), lifted(j));
      if (!line.exists()) continue;
      LineInterval part{-1e300, 1e300};
      for (size_t k = 0; k < count && line.holds(part); ++k)
        if (k != i && k != j) line.cut(lifted(k), part);
      if (!line.holds(part)) continue;
      const uint32_t from = take(seed + line.line.at(part.low));
      ends_.push_back({from, take(seed + line.line.at(part.high))});
    }
  }
}

}  // namespace msq
