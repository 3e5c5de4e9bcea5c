// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/point/onset.h"

#include <cstdint>

#include "base/borrowed.h"
#include "structure/foam/point/edge_search.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

/// Distances are those of the space of the diagram.
struct ModelSpace {
  static Vec3 normal(Vec3 n) { return n; }
  static EdgeLine line(Vec3 a, Vec3 b, Vec3 c) { return EdgeLine(a, b, c); }
  static double slack() { return search_slack; }
};

/// Memory of the search around a point.
struct OnsetWorkspace {
  CellSeeds around;
  std::vector<uint32_t> found;
  std::vector<Vec3> positions;

  size_t bytes() const { return around.bytes(); }
};

}  // namespace

double edge_within(const std::vector<Vec3>& seeds, Vec3 q, double radius) {
  return search_edges(ModelSpace{}, seeds, q, q, radius);
}

double foam_onset(const FoamSeeds& seeds, CellIndex cell, Vec3 q) {
  // Points come cell by cell if the caller can arrange it.
  const Borrowed<OnsetWorkspace> workspace;
  CellSeeds& around = workspace->around;
  std::vector<uint32_t>& found = workspace->found;
  std::vector<Vec3>& positions = workspace->positions;
  around.move_to(seeds, cell);
  // The nearest seed's Voronoi cell, which contains q, has edges. Its points are at most the empty
  // radius from the seed.
  const double most = 2 * seeds.empty_radius();
  return nearest_edge(q, first_onset_radius, most, [&](double radius) -> const std::vector<Vec3>& {
    const CellSeeds::Block& block = around.find_near(q, radius, found);
    positions.clear();
    for (const uint32_t i : found) positions.push_back(block.position(i));
    return positions;
  });
}

}  // namespace msq
