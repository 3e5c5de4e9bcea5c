// SPDX-License-Identifier: Apache-2.0
// The bricks of edges about a box, from the cell cache.
#pragma once

#include <functional>

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/foam_data.h"
#include "strut/segment_selection.h"

namespace msq {

/// Segments of a brick about a box, and where they are.
struct BrickPart {
  const EdgeBrick& brick;
  SegmentFrame frame;
  Box3 wanted;  ///< edges outside do not touch the box; in the coordinates of the segments
};

/// Calls visit(part) for each brick that may have edges that touch a box (model coordinates).
/// is_layer: the box is that of a single layer of samples. A brick that the cache lacks is then
/// built only as deep as the layer needs, the first time: layers here and there rarely need the
/// rest. When another layer needs the brick, all of it is built.
void for_each_brick(const FoamData& foam, const Box3& box, bool is_layer, const Job* job,
                    const std::function<void(const BrickPart&)>& visit);

/// The share of these bricks that the cell cache keeps: 0 to 1. Does not change the cache.
double kept_share_of_bricks(const FoamData& foam, const Box3& box);

/// Structure::for_each_strut for foams of constant radius.
void for_each_foam_strut(const FoamData& foam, const Box3& box, const Structure::TakeStrut& take,
                         const Job* job);

}  // namespace msq
