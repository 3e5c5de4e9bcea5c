// SPDX-License-Identifier: Apache-2.0
// The paper's point query, as it stands there: for comparison, and as an oracle.
#pragma once

#include "structure/foam/foam.h"

namespace msq {

/// What foam_point_inside (point.h) answers, by a search that shares little with it.
bool naive_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);

/// Structure::keep_points and keep_rows, point by point.
void naive_keep_points(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count);
void naive_keep_rows(const Foam& foam, const RowBlock& block, const Job* job);

}  // namespace msq
