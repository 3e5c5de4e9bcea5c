// SPDX-License-Identifier: Apache-2.0
// The parts of lines where a condition holds.
#pragma once

#include <functional>

#include "structure/common/line_graph.h"

namespace msq {

/// Of a point: whether its part of a line stays, and a distance from there within which that does
/// not change; 0 if none is known.
struct KeptPoint {
  bool stays;
  double steady;
};
using KeepPoint = std::function<KeptPoint(Vec2)>;

/// Drops the parts of the graph's lines whose points do not stay. Ends are found within `tolerance`
/// / 64. Parts, and gaps, shorter than the tolerance may be missed.
void keep_parts(LineGraph& graph, double tolerance, const KeepPoint& keep);

}  // namespace msq
