// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/uniform_graph.h"

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/edges/facet_walk.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/point/point.h"

namespace msq {

bool UniformGraph::inside(CellIndex cell, Vec3 q, double radius) const {
  return foam_point_inside(seeds_, cell, q, radius);
}

double UniformGraph::onset(CellIndex cell, Vec3 q) const {
  return foam_onset(seeds_, cell, q);
}

std::shared_ptr<const EdgeBrick> UniformGraph::make_brick(CellIndex corner) const {
  return std::make_shared<const EdgeBrick>(seeds_, corner);
}

bool UniformGraph::has_parts() const {
  return FacetWalk::suits(seeds_);
}

std::shared_ptr<const EdgeBrick> UniformGraph::make_part(CellIndex corner,
                                                         const Owners& owners) const {
  return std::make_shared<const EdgeBrick>(seeds_, corner, owners);
}

double UniformGraph::brick_error() const {
  return edge_error;
}

}  // namespace msq
