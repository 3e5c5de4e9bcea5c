// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/point/onset.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/borrowed.h"
#include "structure/foam/point/edge_line.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

/// Slack for the rounding of distances; additional seeds never change the result.
constexpr double slack = 1e-9;

/// A seed that may matter.
struct NearSeed {
  double plane;  // distance from q to the plane between the seed and the nearest one
  double distance_squared;
  uint32_t index;  // in the order of seeds
  Vec3 position;
};

/// Memory of the search around a point.
struct OnsetWorkspace {
  CellSeeds around;
  std::vector<uint32_t> found;
  std::vector<Vec3> positions;

  size_t bytes() const { return around.bytes(); }
};

/// Whether the plane between two seeds is farther from q than `reach`.
bool too_far(const NearSeed& a, const NearSeed& b, double reach) {
  const Vec3 apart = a.position - b.position;
  const double over = std::abs(a.distance_squared - b.distance_squared) - slack;
  return over > 0 && over * over > 4 * reach * reach * dot(apart, apart);
}

/// The line of three seeds in any order, with the order that EdgeLine requires.
EdgeLine line_of(const NearSeed& a, const NearSeed& b, const NearSeed& c) {
  const NearSeed *x = &a, *y = &b, *z = &c;
  if (x->index > y->index) std::swap(x, y);
  if (y->index > z->index) std::swap(y, z);
  if (x->index > y->index) std::swap(x, y);
  return EdgeLine(x->position, y->position, z->position);
}

}  // namespace

double edge_within(const std::vector<Vec3>& seeds, Vec3 q, double radius) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (seeds.size() < 3) return none;
  const Borrowed<std::vector<NearSeed>> borrowed;
  std::vector<NearSeed>& near = *borrowed;
  near.clear();
  NearSeed nearest{0, none, 0, {}};
  for (uint32_t i = 0; i < seeds.size(); ++i) {
    const Vec3 d = seeds[i] - q;
    near.push_back({0, dot(d, d), i, seeds[i]});
    if (near.back().distance_squared < nearest.distance_squared) nearest = near.back();
  }
  for (NearSeed& s : near) {
    const double apart = length(s.position - nearest.position);
    s.plane = apart > 0 ? (s.distance_squared - nearest.distance_squared) / (2 * apart) : 0;
  }
  std::erase_if(near, [&](const NearSeed& s) { return s.plane > radius + slack; });
  // Seeds first whose faces with the nearest one are near: they make the nearest edges and the
  // relevant cuts.
  std::sort(near.begin(), near.end(), [](const NearSeed& a, const NearSeed& b) {
    return a.plane < b.plane || (a.plane == b.plane && a.index < b.index);
  });

  // As in the point query, with a ball that shrinks to the nearest edge found so far.
  double best = none, reach = radius + slack, chord_squared = radius * radius;
  const size_t count = near.size();
  for (size_t c = 2; c < count && near[c].plane <= reach; ++c)
    for (size_t b = 1; b < c; ++b) {
      if (too_far(near[b], near[c], reach)) continue;
      for (size_t a = 0; a < b; ++a) {
        if (too_far(near[a], near[b], reach) || too_far(near[a], near[c], reach)) continue;
        const EdgeLine line = line_of(near[a], near[b], near[c]);
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, chord_squared);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(near[i].position, part);
        if (!line.holds(part)) continue;
        best = std::min(best, length(line.way_from(part, q)));
        reach = best + slack;
        chord_squared = best * best;
      }
    }
  return best;
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
