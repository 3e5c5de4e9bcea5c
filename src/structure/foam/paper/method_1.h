// SPDX-License-Identifier: Apache-2.0
// Method 1 of the paper: the lines of a neighbourhood cell's triplets of seeds, kept in the cell
// cache. For each sample it determines whether a point on a line is on an edge.
#pragma once

#include "structure/foam/foam_data.h"

namespace msq {

/// Structure::keep_points by Method 1: points are grouped by cell, lines come from the cache.
void method_1_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count);

}  // namespace msq
