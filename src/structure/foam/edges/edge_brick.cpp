// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/edge_brick.h"

#include "base/borrowed.h"
#include "structure/foam/edges/edge_builder.h"
#include "structure/foam/edges/facet_walk.h"
#include "structure/foam/edges/weighted_edges.h"

namespace msq {

namespace {

struct Workspace {
  EdgeBuilder builder;
  std::vector<SegmentSet::Node> nodes;

  size_t bytes() const { return builder.bytes(); }
};

struct WeightedEdgesWorkspace {
  WeightedEdges builder;
  std::vector<SegmentSet::Node> nodes;

  size_t bytes() const { return builder.bytes(); }
};

bool walk_facets(const FoamSeeds& seeds, CellIndex corner, const Owners& owners,
                 SegmentSet& segments) {
  static_assert(FacetWalk::side == EdgeBrick::side);
  if (!FacetWalk::suits(seeds)) return false;
  const Borrowed<FacetWalk> walk;
  if (!walk->build(seeds, corner, EdgeBrick::side, owners)) return false;
  segments = walk->segments();
  return true;
}

}  // namespace

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner)
    : EdgeBrick(seeds, corner, Owners::all(side)) {}

EdgeBrick::EdgeBrick(const FoamSeeds& seeds, CellIndex corner, const Owners& owners)
    : origin_(seeds.scale() * (0.5 * side)), owners_(owners) {
  if (walk_facets(seeds, corner, owners, segments_)) return;
  segments_ = by_cells(seeds, corner).segments_;
  owners_ = Owners::all(side);
}

EdgeBrick EdgeBrick::by_cells(const FoamSeeds& seeds, CellIndex corner) {
  const Borrowed<Workspace> workspace;
  auto& [builder, nodes] = *workspace;
  builder.build(seeds, corner, side);
  EdgeBrick brick;
  brick.origin_ = seeds.scale() * (0.5 * side);
  // The few vertices without an edge of the brick stay: removing them is not worth the time.
  nodes.resize(builder.vertex_count());
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const Vec3 p = builder.vertex(i) - brick.origin_;
    nodes[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  brick.segments_ = SegmentSet(nodes, builder.ends(), builder.starts());
  return brick;
}

EdgeBrick EdgeBrick::of_weighted(const FoamSeeds& seeds, CellIndex corner) {
  const Borrowed<WeightedEdgesWorkspace> workspace;
  auto& [builder, nodes] = *workspace;
  builder.build(seeds, corner, side);
  EdgeBrick brick;
  brick.origin_ = seeds.scale() * (0.5 * side);
  nodes.clear();
  for (const Vec3& vertex : builder.vertices()) {
    const Vec3 p = vertex - brick.origin_;
    nodes.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  brick.segments_ = SegmentSet(nodes, builder.ends(), builder.starts());
  return brick;
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
