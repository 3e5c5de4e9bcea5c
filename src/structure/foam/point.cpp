// SPDX-License-Identifier: Apache-2.0
// The paper's point query (gather, nearest seed, triplets, projection, validity), made to answer the
// capsule solid and to look at few seeds.
// Source: paper, section "Fine-scale Structures" (Voronoi Foams).
//
// Which seeds matter to a point p: let d0 be the distance to its nearest seed, and v a point of an
// edge with |v - p| <= r. No seed is nearer to v than the edge's three, and the seed nearest to p is
// within d0 + r of v, so the three are within d0 + r of v and within d0 + 2 r of p. A seed that makes
// such a point v of a line invalid is nearer to v than that, so it is within d0 + 2 r of p too. Hence
// the seeds within d0 + 2 r decide alone; where they are fewer than three, p is outside.
#include "structure/foam/point.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "structure/foam/edge_line.h"

namespace msq {

namespace {

struct Candidate {
  Vec3 position;
  double distance_squared;
  uint32_t order;  // of its cell: z, then y, then x
};

/// The block of cells within half[axis] of the point's, and how far around the point it reaches.
struct Block {
  int half[3];
  double reach;

  Block(double wanted, Vec3 q, Vec3 scale) {
    reach = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      half[axis] = static_cast<int>(std::ceil(wanted / scale[axis]));
      const double margin = std::min(q[axis], scale[axis] - q[axis]);
      reach = std::min(reach, half[axis] * scale[axis] + margin);
    }
  }
};

/// Fills `found` with the block's seeds and returns their least squared distance.
double gather(const FoamSeeds& seeds, CellIndex cell, Vec3 q, const Block& block,
              std::vector<Candidate>& found) {
  const int *half = block.half;
  found.resize(static_cast<size_t>(2 * half[0] + 1) * static_cast<size_t>(2 * half[1] + 1) *
               static_cast<size_t>(2 * half[2] + 1));
  double nearest_squared = 1e300;
  uint32_t order = 0;
  for (int dz = -half[2]; dz <= half[2]; ++dz)
    for (int dy = -half[1]; dy <= half[1]; ++dy) {
      const uint64_t key = seeds.row_key(cell, dy, dz);
      for (int dx = -half[0]; dx <= half[0]; ++dx, ++order) {
        const Vec3 s = seeds.in_row(key, cell, dx, dy, dz);
        const Vec3 d = s - q;
        const double d2 = dot(d, d);
        nearest_squared = std::min(nearest_squared, d2);
        found[order] = {s, d2, order};
      }
    }
  return nearest_squared;
}

}  // namespace

bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  thread_local std::vector<Candidate> found;
  // Room for the rounding of distances; a seed too many never changes the answer.
  constexpr double slack = 1e-9;
  double needed;
  for (double wanted = 1;; wanted += 1) {
    const Block block(wanted, q, seeds.scale());
    needed = std::sqrt(gather(seeds, cell, q, block, found)) + 2 * radius + slack;
    if (needed <= block.reach) break;
  }
  const double needed_squared = needed * needed;
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const Candidate& c) { return c.distance_squared > needed_squared; }),
              found.end());
  if (found.size() < 3) return false;
  // Near seeds first: they make the edges that matter and the cuts that bind.
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_squared < b.distance_squared ||
           (a.distance_squared == b.distance_squared && a.order < b.order);
  });

  const double r2 = radius * radius;
  for (size_t c = 2; c < found.size(); ++c)
    for (size_t b = 1; b < c; ++b)
      for (size_t a = 0; a < b; ++a) {
        const Candidate* triple[3] = {&found[a], &found[b], &found[c]};
        std::sort(triple, triple + 3, [](const Candidate* l, const Candidate* r) {
          return l->order < r->order;
        });
        const EdgeLine line(triple[0]->position, triple[1]->position, triple[2]->position);
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, r2);
        for (size_t i = 0; i < found.size() && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(found[i].position, part);
        if (line.holds(part)) return true;
      }
  return false;
}

}  // namespace msq
