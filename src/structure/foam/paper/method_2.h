// SPDX-License-Identifier: Apache-2.0
// Method 2 of the paper: the edges of a neighbourhood cell from a Delaunay triangulation, kept in
// the cell cache.
#pragma once

#include "structure/foam/foam_data.h"

namespace msq {

/// Structure::keep_points by Method 2: points are grouped by cell, edges come from the cache.
void method_2_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count);

}  // namespace msq
