// SPDX-License-Identifier: Apache-2.0
// The edges are read from the cells of the seeds (brick_cells.h). If rounding defeats both the walk
// and the cuts, every pair of neighbours is tried by the definition itself (edge_line.h), which
// needs no graph.
#include "structure/foam/edges/edge_builder.h"

#include "base/job.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

void EdgeBuilder::build(const FoamSeeds& seeds, CellIndex corner, int side, bool wants_seeds) {
  cells_.move_to(seeds, corner, side);
  has_jitter_ = seeds.jitter() > 0;
  wants_seeds_ = wants_seeds;
  ends_.clear();
  starts_.clear();
  triples_.clear();
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      check_cancelled();
      starts_.push_back(static_cast<uint32_t>(ends_.size()));
      for (int x = 0; x < side; ++x) add_owned_edges(block().index(x, y, z));
    }
}

/// Seeds come in the order of their cells.
void EdgeBuilder::add_owned_edges(size_t own) {
  // Without jitter all vertices have eight seeds. A walk that finds a way through the roundings
  // would name three of them for each edge, and rays would differ by the choice.
  if (has_jitter_ && add_by_walk(own)) return;
  if (!add_by_cuts(own)) add_by_definition(own);
}

bool EdgeBuilder::add_by_walk(size_t own) {
  const int64_t before = cells_.walk(own);
  if (before < 0) return false;
  const std::vector<uint32_t>& numbers = cells_.shared().numbers();
  // Planes are in the order of cells: those before the own cell come first.
  const VoronoiCell& cell = cells_.walked();
  const uint32_t* seeds = cell.planes().seed;
  cell.for_each_edge(static_cast<uint32_t>(before),
                     [&](size_t from, size_t to, uint32_t a, uint32_t b) {
                       ends_.push_back({numbers[from], numbers[to]});
                       if (wants_seeds_)
                         triples_.push_back({static_cast<uint32_t>(own), seeds[a], seeds[b]});
                     });
  return true;
}

/// If the cuts are impossible, returns false and appends nothing.
bool EdgeBuilder::add_by_cuts(size_t own) {
  if (!cells_.cut(own)) return false;
  const Vec3 seed = block().position(own);
  const auto is_after = [&](uint32_t plane) {
    return plane >= ClippedCell::first_neighbour &&
           cells_.neighbours()[plane - ClippedCell::first_neighbour].after;
  };
  cells_.clipped().for_each_edge(is_after, [&](Vec3 from, Vec3 to) {
    ends_.push_back({take(seed + from), take(seed + to)});
    add_unknown(own);
  });
  return true;
}

/// Every pair of later neighbours, which the cuts have found, cut by all others.
void EdgeBuilder::add_by_definition(size_t own) {
  const Vec3 seed = block().position(own);
  const std::vector<BrickCells::Neighbour>& neighbours = cells_.neighbours();
  const size_t count = neighbours.size();
  for (size_t i = 0; i < count; ++i) {
    if (!neighbours[i].after) continue;
    check_cancelled();
    for (size_t j = i + 1; j < count; ++j) {
      if (!neighbours[j].after) continue;
      const EdgeLine line(Vec3{}, neighbours[i].position, neighbours[j].position);
      if (!line.exists()) continue;
      LineInterval part{-1e300, 1e300};
      for (size_t k = 0; k < count && line.holds(part); ++k)
        if (k != i && k != j) line.cut(neighbours[k].position, part);
      if (!line.holds(part)) continue;
      ends_.push_back({take(seed + line.at(part.low)), take(seed + line.at(part.high))});
      add_unknown(own);
    }
  }
}

}  // namespace msq
