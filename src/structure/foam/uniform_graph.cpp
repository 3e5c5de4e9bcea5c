// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/uniform_graph.h"

#include <algorithm>

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/point/point.h"

namespace msq {

bool UniformGraph::inside(CellIndex cell, Vec3 q, double radius) const {
  return foam_point_inside(seeds_, cell, q, radius);
}

double UniformGraph::onset(CellIndex cell, Vec3 q) const {
  return foam_onset(seeds_, cell, q);
}

FoamGraph::BrickLayout UniformGraph::brick_layout() const {
  return {EdgeBrick::side, EdgeBrick::lead};
}

std::shared_ptr<const EdgeBrick> UniformGraph::make_brick(CellIndex corner) const {
  return std::make_shared<const EdgeBrick>(seeds_, corner);
}

double UniformGraph::brick_error() const {
  return edge_error;
}

// The cost of a sample grows with the square of the radius, from about 0.08 on
// (docs/benchmarks.md).
double UniformGraph::critical_samples(const Box3&, double max_radius) const {
  constexpr double at_tenth = 60;
  const double r = std::max(max_radius, 0.08);
  return at_tenth * 0.01 / (r * r);
}

}  // namespace msq
