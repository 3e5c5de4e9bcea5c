// SPDX-License-Identifier: Apache-2.0
// Rows of samples by the voids of cells, from faces that are each found once.
#pragma once

#include "structure/foam/walls/foam_walls.h"

namespace msq {

/// Structure::keep_rows for walls. False, and nothing is done, where so few samples lie in each
/// cell that evaluating them costs less than the faces, or where a graded foam has holes.
bool keep_void_rows(const FoamWalls& walls, const RowBlock& block, const Job* job);

}  // namespace msq
