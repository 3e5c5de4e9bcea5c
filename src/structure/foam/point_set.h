// SPDX-License-Identifier: Apache-2.0
// Sets of points and rows of samples by the point query.
#pragma once

#include "structure/foam/foam.h"

namespace msq {

/// Structure::keep_points: points are grouped by cell and asked in batches.
void foam_keep_points_by_point(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count);

/// Structure::keep_rows for grids of few samples a cell: every sample is asked.
void foam_keep_rows_by_point(const Foam& foam, const RowBlock& block, const Job* job);

}  // namespace msq
