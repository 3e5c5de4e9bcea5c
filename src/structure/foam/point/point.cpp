// SPDX-License-Identifier: Apache-2.0
// The paper's point query (gather, nearest seed, triplets, projection, validity), changed to give
// the capsule solid and to examine few seeds. Source: paper, section "Fine-scale Structures"
// (Voronoi Foams).
//
// Which seeds matter to a point p: let d0 be the distance to its nearest seed, and v a point of an
// edge with |v - p| <= r. No seed is nearer to v than the edge's three, and the seed nearest to p
// is within d0 + r of v. So the three are within d0 + r of v and within d0 + 2 r of p. A seed that
// makes such a point v of a line invalid is nearer to v than that, so it is within d0 + 2 r of p
// too. Hence the seeds within d0 + 2 r decide alone. If they are fewer than three, p is outside.
#include "structure/foam/point/point.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/point/meets_edge.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

struct Ranked {
  double distance_squared;
  uint32_t index;
};

/// Seeds in the order in which they are tried.
struct Order {
  std::vector<Ranked> ranked;
  std::vector<uint32_t> order;
};

/// The seeds around the last point's cell. Points come cell by cell if the caller can arrange it.
struct PointWorkspace {
  CellSeeds around;
  std::vector<uint32_t> found;
  std::vector<Vec3> near;
  Order order;

  size_t bytes() const { return around.bytes(); }
};

bool is_inside(const std::vector<Vec3>& near, Vec3 q, double radius, Order& workspace) {
  auto& [ranked, order] = workspace;
  ranked.clear();
  for (uint32_t i = 0; i < near.size(); ++i) {
    const Vec3 d = near[i] - q;
    ranked.push_back({dot(d, d), i});
  }
  // Near seeds first: they make the relevant edges and cuts.
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.distance_squared < b.distance_squared ||
           (a.distance_squared == b.distance_squared && a.index < b.index);
  });
  order.clear();
  for (const Ranked& seed : ranked) order.push_back(seed.index);
  return meets_edge(
      order, [&](uint32_t i) { return near[i]; }, q, radius);
}

}  // namespace

bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  const Borrowed<PointWorkspace> workspace;
  CellSeeds& around = workspace->around;
  std::vector<uint32_t>& found = workspace->found;
  std::vector<Vec3>& near = workspace->near;
  around.move_to(seeds, cell);
  const CellSeeds::Block& block = around.find_near(q, radius, found);
  if (found.size() < 3) return false;
  near.clear();
  for (const uint32_t i : found) near.push_back(block.position(i));
  return is_inside(near, q, radius, workspace->order);
}

bool foam_point_inside(const std::vector<Vec3>& near, Vec3 q, double radius) {
  const Borrowed<Order> order;
  return is_inside(near, q, radius, *order);
}

}  // namespace msq
