// SPDX-License-Identifier: Apache-2.0
// Polylines between the points where lines of a graph meet.
#pragma once

#include "base/working_memory.h"
#include "structure/common/line_graph.h"

namespace msq {

struct Polyline {
  CountedVector<Vec2> points;
  bool is_closed = false;  ///< the last point is joined to the first, and is not equal to it
};

/// The lines of a graph, joined where just two meet. Where three or more meet, all end.
CountedVector<Polyline> chain(const LineGraph& graph);

/// Drops points of a path within the window that are no farther than `distance` from what remains.
/// Others stay: more lines may meet there, as other windows show. Source: Douglas and Peucker,
/// "Algorithms for the reduction of the number of points required to represent a digitized line",
/// 1973.
void simplify(Polyline& path, double distance, const Box2& window);

}  // namespace msq
