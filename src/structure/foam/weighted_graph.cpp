// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/weighted_graph.h"

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/point/weighted_point.h"

namespace msq {

bool WeightedGraph::inside(CellIndex cell, Vec3 q, double radius) const {
  return weighted_point_inside(seeds_, cell, q, radius);
}

double WeightedGraph::onset(CellIndex cell, Vec3 q) const {
  return weighted_onset(seeds_, cell, q);
}

std::shared_ptr<const EdgeBrick> WeightedGraph::make_brick(CellIndex corner) const {
  return std::make_shared<const EdgeBrick>(EdgeBrick::of_weighted(seeds_, corner));
}

double WeightedGraph::brick_error() const {
  return edge_error;
}

// A sample takes 120 ns, several times as long as without weights.
double WeightedGraph::drawing_share() const {
  return 0.1;
}

}  // namespace msq
