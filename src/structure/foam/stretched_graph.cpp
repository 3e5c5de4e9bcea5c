// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/stretched_graph.h"

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/point/stretched_point.h"

namespace msq {

bool StretchedGraph::inside(CellIndex cell, Vec3 q, double radius) const {
  return stretched_point_inside(stretch_, cell, q, radius);
}

double StretchedGraph::onset(CellIndex cell, Vec3 q) const {
  return stretched_onset(stretch_, cell, q);
}

std::shared_ptr<const EdgeBrick> StretchedGraph::make_brick(CellIndex corner) const {
  return std::make_shared<const EdgeBrick>(EdgeBrick(stretch_.seeds(), corner), stretch_.factor());
}

// In diagram units, coordinates of a brick are below 8 and their error is edge_error. Moved to
// model space, they are below 8 factors, and rounded once more: by at most 2^-22 factors.
double StretchedGraph::brick_error() const {
  return 2 * edge_error * stretch_.max_factor();
}

// A sample takes 120 ns, several times as long as where cells are not stretched.
double StretchedGraph::drawing_share() const {
  return 0.1;
}

}  // namespace msq
