// SPDX-License-Identifier: Apache-2.0
// Paths along the lines of a graph.
#pragma once

#include <vector>

#include "structure/common/line_graph.h"

namespace msq {

struct Polyline {
  std::vector<Vec2> points;
  bool is_closed = false;  ///< the last point is joined to the first, and is not equal to it
};

/// Paths that hold each line of a graph once. Through a point they join the two lines that go on
/// most nearly straight, then the next two: of three lines that meet, two are joined, and one ends.
/// So no fewer paths would do.
std::vector<Polyline> chain(const LineGraph& graph);

/// Drops points of a path that are no farther than `distance` from what remains. Source: Douglas
/// and Peucker, "Algorithms for the reduction of the number of points required to represent a
/// digitized line", 1973.
void simplify(Polyline& path, double distance);

}  // namespace msq
