// SPDX-License-Identifier: Apache-2.0
// The edges of a graded foam's Voronoi diagram, in bricks as those of other foams (edges.h).
#pragma once

#include <memory>

#include "structure/foam/edges.h"
#include "structure/foam/graded_seeds.h"

namespace msq {

/// The edges owned by the seeds of the brick of seeds.brick_side()^3 cells whose first is `corner`.
std::shared_ptr<const EdgeBrick> graded_edge_brick(const std::shared_ptr<const GradedSeeds>& seeds,
                                                   CellIndex corner);

}  // namespace msq
