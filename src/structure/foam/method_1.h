// SPDX-License-Identifier: Apache-2.0
// Method 1 of the paper: the lines of a neighbourhood cell's triplets of seeds, kept in the cell
// cache; whether a place on a line is on an edge is found out for each sample.
#pragma once

#include "structure/foam/foam.h"

namespace msq {

/// Structure::keep_points by Method 1: points are grouped by cell, lines come from the cache.
void method_1_keep_points(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count);

}  // namespace msq
