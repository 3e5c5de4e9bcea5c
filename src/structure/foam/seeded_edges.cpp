// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeded_edges.h"

#include "structure/foam/edge_builder.h"

namespace msq {

SeededEdges::SeededEdges(const FoamSeeds& seeds, CellIndex corner) {
  thread_local EdgeBuilder builder;
  thread_local std::vector<SegmentSet::Node> nodes;
  builder.build(seeds, corner, side, true);
  nodes.resize(builder.vertex_count());
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const Vec3 p = builder.vertex(i);
    nodes[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  segments_ = SegmentSet(nodes, builder.ends(), builder.starts());
  seeds_.reserve(builder.seeds().size());
  for (const std::array<uint32_t, 3>& triple : builder.seeds()) {
    std::array<Offset, 3>& offsets = seeds_.emplace_back();
    for (size_t i = 0; i < 3; ++i) {
      const std::array<int, 3> cell = builder.block().cell(triple[i]);
      offsets[i] = {static_cast<int8_t>(cell[0]), static_cast<int8_t>(cell[1]),
                    static_cast<int8_t>(cell[2])};
    }
  }
}

}  // namespace msq
