// SPDX-License-Identifier: Apache-2.0
// Lines of a graph that lie on each other.
#pragma once

#include "structure/common/line_graph.h"

namespace msq {

/// Splits lines at points of the graph that are no farther than `distance` from them, and drops
/// parts that occur twice. Points are farther than that from each other (LineGraph::weld()).
void split_at_points(LineGraph& graph, double distance);

}  // namespace msq
