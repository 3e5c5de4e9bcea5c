// SPDX-License-Identifier: Apache-2.0
// Lines of walls in a plane, interrupted where the walls have holes.
#pragma once

#include "structure/common/line_graph.h"

namespace msq {

class FoamWalls;

/// `graph`: the faces of the foam's diagram in the plane of that z, one line for each.
void cut_vents(const FoamWalls& walls, double z, LineGraph& graph);

}  // namespace msq
