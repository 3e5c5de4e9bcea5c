// SPDX-License-Identifier: Apache-2.0
// The decision of the point query, for given relevant seeds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "structure/foam/point/edge_line.h"

namespace msq {

/// Whether an edge of three seeds, cut by the others, comes within `radius` of q. `near`: the seeds
/// by numbers that ascend in the order of seeds. It is fastest if seeds that make edges and cut
/// them come first. position(i) is the position of seed i.
template <class Position>
bool meets_edge(const std::vector<uint32_t>& near, Position&& position, Vec3 q, double radius) {
  const size_t count = near.size();
  const double r2 = radius * radius;
  for (size_t c = 2; c < count; ++c)
    for (size_t b = 1; b < c; ++b)
      for (size_t a = 0; a < b; ++a) {
        uint32_t triple[3] = {near[a], near[b], near[c]};
        std::sort(triple, triple + 3);
        const EdgeLine line(position(triple[0]), position(triple[1]), position(triple[2]));
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, r2);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(position(near[i]), part);
        if (line.holds(part)) return true;
      }
  return false;
}

}  // namespace msq
