// SPDX-License-Identifier: Apache-2.0
// As in point.cpp, only seeds within d0 + 2 r of a point p can matter, d0 being its distance to the
// nearest one, s0. Where a coarse cell meets fine ones these may be thousands, so a second bound
// excludes seeds. A seed s matters only if, at some point of the ball of radius r about p, it is no
// farther than s0. The plane between s and s0 is ((s - p)^2 - (s0 - p)^2) / (2 |s - s0|) from p. If
// that exceeds r, the ball lies on the side of s0. Then an edge of s does not meet the ball, and s0
// cuts away every part of a line in the ball that s would.
//
// The tolerances of EdgeLine are lengths, areas and volumes. They would be too large for seeds that
// are close to each other compared with a cell. So all lengths are in sizes of the leaf of s0, a
// power of two and hence without rounding.
#include "structure/foam/point/graded_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/point/meets_edge.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

namespace {

/// Seeds that may matter, in the order of seeds, and the order in which to try them.
struct NearSeeds {
  std::vector<Vec3> positions;
  std::vector<double> planes;  // distances to the planes between the seeds and the nearest one
  std::vector<uint32_t> order;
  std::vector<GradedSeedName> names;  // relative to the point's cell; only if needed
};

/// Positions are in sizes of the leaf of the nearest seed, everything else is in foam units.
void gather(SeedTrees& trees, CellIndex cell, Vec3 q, const LeafSeed& nearest,
            double nearest_squared, double radius, bool wants_names, NearSeeds& near) {
  const double unit = 1 << nearest.level;
  // Slack for the rounding of distances; additional seeds never change the result.
  constexpr double slack = 1e-9, slack_squared = 1e-12;
  const double reach = std::sqrt(nearest_squared) + 2 * radius + slack;
  const double reach_squared = reach * reach;
  const double twice_radius = 2 * (radius + slack);
  // Whether a seed within sqrt(apart_squared) of s0 is too far, if its squared distance exceeds (s0
  // - p)^2 by `over`.
  const auto too_far = [&](double over, double apart_squared) {
    over -= slack_squared;
    return over > 0 && over * over > twice_radius * twice_radius * apart_squared;
  };
  near.positions.clear();
  near.planes.clear();
  near.names.clear();
  trees.visit(
      cell, Box3{q, q}.grown(reach),
      [&](const Box3& box) {
        const double least = min_squared(box, q);
        return least <= reach_squared &&
               !too_far(least - nearest_squared, max_squared(box, nearest.position));
      },
      [&](const LeafSeed& seed) {
        const Vec3 d = seed.position - q, apart = seed.position - nearest.position;
        const double squared = dot(d, d), apart_squared = dot(apart, apart);
        if (squared > reach_squared || too_far(squared - nearest_squared, apart_squared)) return;
        near.positions.push_back(seed.position * unit);
        if (wants_names) near.names.push_back(name_of(seed));
        near.planes.push_back(
            apart_squared > 0 ? (squared - nearest_squared) / std::sqrt(apart_squared) : -1);
      });
  // Seeds first whose faces with the nearest one are near: they make the relevant edges and cuts.
  near.order.resize(near.positions.size());
  for (uint32_t i = 0; i < near.order.size(); ++i) near.order[i] = i;
  std::sort(near.order.begin(), near.order.end(), [&](uint32_t a, uint32_t b) {
    return near.planes[a] < near.planes[b] || (near.planes[a] == near.planes[b] && a < b);
  });
}

LeafSeed nearest_seed(SeedTrees& trees, CellIndex cell, Vec3 q, double& distance_squared) {
  LeafSeed nearest = trees.at(cell, q);
  const Vec3 d = nearest.position - q;
  distance_squared = dot(d, d);
  trees.nearest(cell, q, distance_squared, nearest, [](const LeafSeed&) { return true; });
  return nearest;
}

}  // namespace

bool graded_point_inside(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                         double radius) {
  // The density field may be the host's.
  const Borrowed<SeedForest> forest;
  const Borrowed<NearSeeds> borrowed_near;
  SeedTrees& trees = forest->of(seeds);
  NearSeeds& near = *borrowed_near;
  double nearest_squared;
  const LeafSeed nearest = nearest_seed(trees, cell, q, nearest_squared);

  // A radius of many leaves contains very many seeds, and usually an edge near p: growing radii
  // find it first. Points inside for one of the radii are inside for the last.
  const double unit = 1 << nearest.level;
  for (double tried = std::min(radius, 1 / unit);; tried = std::min(radius, 2 * tried)) {
    gather(trees, cell, q, nearest, nearest_squared, tried, false, near);
    if (near.order.size() >= 3 &&
        meets_edge(
            near.order, [&](uint32_t i) { return near.positions[i]; }, q * unit, tried * unit))
      return true;
    if (tried >= radius) return false;
  }
}

void find_graded_edges_near(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                            double radius, std::vector<NearGradedEdge>& struts) {
  // The density field may be the host's.
  const Borrowed<SeedForest> forest;
  const Borrowed<NearSeeds> borrowed_near;
  SeedTrees& trees = forest->of(seeds);
  NearSeeds& near = *borrowed_near;
  struts.clear();
  double nearest_squared;
  const LeafSeed nearest = nearest_seed(trees, cell, q, nearest_squared);
  gather(trees, cell, q, nearest, nearest_squared, radius, true, near);
  const double unit = 1 << nearest.level, reach = radius * unit;
  const Vec3 p = q * unit;
  const size_t count = near.positions.size();
  // Whether the plane between two seeds is farther than the radius: then their edges are, too.
  const auto too_far = [&](size_t a, size_t b) {
    const Vec3 to_a = near.positions[a] - p, to_b = near.positions[b] - p, apart = to_a - to_b;
    const double over = std::abs(dot(to_a, to_a) - dot(to_b, to_b)) - 1e-9;
    return over > 0 && over * over > 4 * reach * reach * dot(apart, apart);
  };
  for (size_t a = 0; a < count; ++a)
    for (size_t b = a + 1; b < count; ++b) {
      if (too_far(a, b)) continue;
      check_cancelled();
      for (size_t c = b + 1; c < count; ++c) {
        if (too_far(a, c) || too_far(b, c)) continue;
        const EdgeLine line(near.positions[a], near.positions[b], near.positions[c]);
        if (!line.exists()) continue;
        LineInterval part = line.chord(p, reach * reach);
        for (size_t i = 0; i < count && line.holds(part); ++i) {
          const uint32_t cut = near.order[i];
          if (cut != a && cut != b && cut != c) line.cut(near.positions[cut], part);
        }
        if (!line.holds(part)) continue;
        const Vec3 d = line.way_from(part, p);
        double lead = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < count; ++i)
          if (i != a && i != b && i != c) lead = std::min(lead, line.lead(near.positions[i], p));
        struts.push_back({{near.names[a], near.names[b], near.names[c]},
                          dot(d, d) / (unit * unit),
                          lead,
                          {line.at(part.low) * (1 / unit), line.at(part.high) * (1 / unit)}});
      }
    }
}

double graded_onset(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q) {
  // The density field may be the host's.
  const Borrowed<SeedForest> forest;
  const Borrowed<NearSeeds> borrowed_near;
  SeedTrees& trees = forest->of(seeds);
  NearSeeds& near = *borrowed_near;
  double nearest_squared;
  const LeafSeed nearest = nearest_seed(trees, cell, q, nearest_squared);
  const double unit = 1 << nearest.level;
  // A coarse leaf may begin right behind a fine one: the last radius is that of cells.
  const double most = 2 * seeds->cells().empty_radius() * unit;
  const auto seeds_within = [&](double radius) -> const std::vector<Vec3>& {
    gather(trees, cell, q, nearest, nearest_squared, radius / unit, false, near);
    return near.positions;
  };
  return nearest_edge(q * unit, first_onset_radius, most, seeds_within) / unit;
}

}  // namespace msq
