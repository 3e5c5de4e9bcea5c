// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/graded_graph.h"

#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/point/graded_point.h"

namespace msq {

bool GradedGraph::inside(CellIndex cell, Vec3 q, double radius) const {
  return graded_point_inside(seeds_, cell, q, radius);
}

double GradedGraph::onset(CellIndex cell, Vec3 q) const {
  return graded_onset(seeds_, cell, q);
}

std::shared_ptr<const EdgeBrick> GradedGraph::make_brick(CellIndex corner) const {
  return graded_edge_brick(seeds_, corner);
}

double GradedGraph::brick_error() const {
  return edge_error;
}

// For each leaf: its edges take 9 to 17 us, a point 1 to 2 us.
double GradedGraph::critical_samples(const Box3& box, double) const {
  constexpr double samples_per_leaf = 10;
  return samples_per_leaf * seeds_->mean_density(box);
}

// Drawing the edges of a leaf takes 0.2 us.
double GradedGraph::drawing_share() const {
  return 0.05;
}

}  // namespace msq
