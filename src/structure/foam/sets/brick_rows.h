// SPDX-License-Identifier: Apache-2.0
// Rows of foam samples: each edge is built once and drawn as spans.
#pragma once

#include "structure/foam/foam_data.h"
#include "strut/span_raster.h"

namespace msq {

/// Structure::keep_rows for foams, and draw_rows where all samples are alive. Returns false and
/// does nothing if each cell has so few samples that evaluating them costs less than the edges:
/// building those that the cell cache does not keep, and drawing all.
bool keep_brick_rows(const FoamData& foam, const RowBlock& block, AliveRows alive, const Job* job);

}  // namespace msq
