// SPDX-License-Identifier: Apache-2.0
// Sets of points and rows of samples by the point query.
#pragma once

#include "structure/foam/foam_data.h"

namespace msq {

/// Structure::keep_points: points are grouped by cell and evaluated in batches.
void foam_keep_points_by_point(const FoamData& foam, const Vec3* points, uint8_t* alive,
                               size_t count);

/// Structure::keep_rows for grids with few samples per cell: evaluates every sample.
void foam_keep_rows_by_point(const FoamData& foam, const RowBlock& block, const Job* job);

}  // namespace msq
