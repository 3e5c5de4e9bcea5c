// SPDX-License-Identifier: Apache-2.0
// The paper's point query, unchanged: for comparison, and as an oracle.
#pragma once

#include "structure/foam/foam_data.h"

namespace msq {

/// Same result as foam_point_inside (point.h), by a search that shares little with it.
bool naive_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);

/// Structure::keep_points and keep_rows, point by point.
void naive_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count);
void naive_keep_rows(const FoamData& foam, const RowBlock& block, const Job* job);

}  // namespace msq
