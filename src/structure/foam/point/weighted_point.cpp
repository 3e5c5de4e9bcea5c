// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/point/weighted_point.h"

#include "base/borrowed.h"
#include "structure/foam/point/edge_search.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/point/weighted_line.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

struct WeightedSpace {
  static Vec3 normal(Vec3 n) { return n; }
  static WeightedLine line(const LiftedSeed& a, const LiftedSeed& b, const LiftedSeed& c) {
    return WeightedLine(a, b, c);
  }
  static double slack() { return search_slack; }
};

/// The seeds that may matter to a point. Points come cell by cell where the caller can arrange it.
struct WeightedWorkspace {
  CellSeeds around;
  std::vector<uint32_t> found;
  std::vector<LiftedSeed> lifted;
  std::vector<NearSeedOf<LiftedSeed>> near;

  const CellSeeds::Block& find(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
    around.move_to(seeds, cell);
    const CellSeeds::Block& block = around.find_near(q, radius, found);
    lifted.clear();
    for (const uint32_t i : found) lifted.push_back(block.lifted(i));
    return block;
  }

  size_t bytes() const { return around.bytes(); }
};

}  // namespace

bool weighted_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  const Borrowed<WeightedWorkspace> workspace;
  workspace->find(seeds, cell, q, radius);
  return search_edges(WeightedSpace{}, workspace->lifted, q, q, radius, true) <
         std::numeric_limits<double>::infinity();
}

double weighted_onset(const FoamSeeds& seeds, CellIndex cell, Vec3 q) {
  const Borrowed<WeightedWorkspace> workspace;
  // The nearest seed's cell holds the point, has edges, and lies within the empty radius of it.
  const double most = 2 * seeds.empty_radius();
  for (double radius = first_onset_radius;; radius *= 2) {
    workspace->find(seeds, cell, q, radius);
    const double found = search_edges(WeightedSpace{}, workspace->lifted, q, q, radius);
    if (found <= radius) return found;
    if (radius >= most) return radius;
  }
}

void find_weighted_edges_near(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius,
                              std::vector<NearEdge>& struts) {
  const Borrowed<WeightedWorkspace> workspace;
  struts.clear();
  const CellSeeds::Block& block = workspace->find(seeds, cell, q, radius);
  if (workspace->lifted.size() < 3) return;
  const WeightedSpace space;
  auto& near = workspace->near;
  find_near_planes(space, workspace->lifted, q, radius, near);
  const double reach = radius + WeightedSpace::slack();
  const auto cell_of = [&](const auto& seed) {
    const int n = static_cast<int>(workspace->found[seed.index]), x = 2 * block.half[0] + 1,
              y = 2 * block.half[1] + 1;
    return CellIndex{cell.x + n % x - block.half[0], cell.y + n / x % y - block.half[1],
                     cell.z + n / x / y - block.half[2]};
  };
  const size_t count = near.size();
  for (size_t a = 0; a < count; ++a)
    for (size_t b = a + 1; b < count; ++b) {
      if (too_far(space, near[a], near[b], reach)) continue;
      for (size_t c = b + 1; c < count; ++c) {
        if (too_far(space, near[a], near[c], reach) || too_far(space, near[b], near[c], reach))
          continue;
        const WeightedLine line = line_of(space, near[a], near[b], near[c]);
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, radius * radius);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(near[i].position, part);
        if (!line.holds(part)) continue;
        const Vec3 d = line.way_from(part, q);
        struts.push_back(
            {line.line, part, {cell_of(near[a]), cell_of(near[b]), cell_of(near[c])}, dot(d, d)});
      }
    }
}

}  // namespace msq
