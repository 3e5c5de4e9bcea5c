// SPDX-License-Identifier: Apache-2.0
// The paper's point query (gather, nearest seed, triplets, projection, validity), made to answer
// the capsule solid and to look at few seeds. Source: paper, section "Fine-scale Structures"
// (Voronoi Foams).
//
// Which seeds matter to a point p: let d0 be the distance to its nearest seed, and v a point of an
// edge with |v - p| <= r. No seed is nearer to v than the edge's three, and the seed nearest to p
// is within d0 + r of v, so the three are within d0 + r of v and within d0 + 2 r of p. A seed that
// makes such a point v of a line invalid is nearer to v than that, so it is within d0 + 2 r of p
// too. Hence the seeds within d0 + 2 r decide alone; where they are fewer than three, p is outside.
#include "structure/foam/point.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "structure/foam/cell_seeds.h"
#include "structure/foam/edge_line.h"

namespace msq {

bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  // Points come cell by cell where the caller can arrange it.
  thread_local CellSeeds around;
  thread_local std::vector<double> distance_squared;
  thread_local std::vector<uint32_t> near;
  around.move_to(seeds, cell);

  // Room for the rounding of distances; a seed too many never changes the answer.
  constexpr double slack = 1e-9;
  const CellSeeds::Block* block;
  double needed;
  for (size_t step = 0;; ++step) {
    block = &around.block(step);
    needed = std::sqrt(CellSeeds::distances(*block, q, distance_squared)) + 2 * radius + slack;
    if (needed <= block->reach(q, seeds.scale())) break;
  }
  CellSeeds::within(*block, distance_squared, needed * needed, near);
  const size_t count = near.size();
  if (count < 3) return false;

  // Near seeds first: they make the edges that matter and the cuts that bind.
  std::sort(near.begin(), near.end(), [](uint32_t a, uint32_t b) {
    return distance_squared[a] < distance_squared[b] ||
           (distance_squared[a] == distance_squared[b] && a < b);
  });
  const double r2 = radius * radius;
  for (size_t c = 2; c < count; ++c)
    for (size_t b = 1; b < c; ++b)
      for (size_t a = 0; a < b; ++a) {
        uint32_t triple[3] = {near[a], near[b], near[c]};
        std::sort(triple, triple + 3);
        const EdgeLine line(block->position(triple[0]), block->position(triple[1]),
                            block->position(triple[2]));
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, r2);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(block->position(near[i]), part);
        if (line.holds(part)) return true;
      }
  return false;
}

}  // namespace msq
