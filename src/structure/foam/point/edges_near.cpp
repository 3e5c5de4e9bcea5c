// SPDX-License-Identifier: Apache-2.0
// As the point query (point.cpp), but examines all triples of relevant seeds and does not stop at
// the first.
#include "structure/foam/point/edges_near.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/borrowed.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

struct EdgesNearWorkspace {
  CellSeeds around;
  std::vector<uint32_t> near;

  size_t bytes() const { return around.bytes(); }
};

}  // namespace

void find_edges_near(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius,
                     std::vector<NearEdge>& struts) {
  const Borrowed<EdgesNearWorkspace> workspace;
  CellSeeds& around = workspace->around;
  std::vector<uint32_t>& near = workspace->near;
  struts.clear();
  around.move_to(seeds, cell);
  const CellSeeds::Block& block = around.find_near(q, radius, near);
  const auto cell_of = [&](uint32_t i) {
    const int n = static_cast<int>(i), x = 2 * block.half[0] + 1, y = 2 * block.half[1] + 1;
    return CellIndex{cell.x + n % x - block.half[0], cell.y + n / x % y - block.half[1],
                     cell.z + n / x / y - block.half[2]};
  };
  const size_t count = near.size();
  for (size_t a = 0; a < count; ++a)
    for (size_t b = a + 1; b < count; ++b)
      for (size_t c = b + 1; c < count; ++c) {
        const EdgeLine line(block.position(near[a]), block.position(near[b]),
                            block.position(near[c]));
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, radius * radius);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(block.position(near[i]), part);
        if (!line.holds(part)) continue;
        const Vec3 d = line.way_from(part, q);
        double lead = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < count; ++i)
          if (i != a && i != b && i != c)
            lead = std::min(lead, line.lead(block.position(near[i]), q));
        struts.push_back(
            {line, part, {cell_of(near[a]), cell_of(near[b]), cell_of(near[c])}, dot(d, d), lead});
      }
}

}  // namespace msq
