// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges.h"

#include "structure/foam/edge_builder.h"

namespace msq {

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner)
    : origin_(seeds.scale() * (0.5 * side)) {
  thread_local EdgeBuilder builder;
  thread_local std::vector<SegmentSet::Node> nodes;
  builder.build(seeds, corner, side);
  // The few vertices that no edge of the brick has are not worth sorting out.
  nodes.resize(builder.vertex_count());
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const Vec3 p = builder.vertex(i) - origin_;
    nodes[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  segments_ = SegmentSet(nodes, builder.ends(), builder.starts());
}

std::vector<FoamEdge> EdgeBrick::edges() const {
  std::vector<FoamEdge> edges;
  for (size_t i = 0; i < segments_.count(); ++i) {
    const FloatSegment s = segments_.at(i);
    edges.push_back(
        {origin_ + Vec3{s.a[0], s.a[1], s.a[2]}, origin_ + Vec3{s.b[0], s.b[1], s.b[2]}});
  }
  return edges;
}

}  // namespace msq
