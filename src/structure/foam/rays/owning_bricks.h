// SPDX-License-Identifier: Apache-2.0
// Which bricks may own the edges that come near the cells of a brick.
//
// By the empty radius alone, owners of edges (edge_brick.h) may lie two cells (cubes) from a point
// near them. They are rarely that far, so this examines the seeds themselves. All three seeds of an
// edge are nearest seeds of its points. A cell, grown, is divided into boxes. A seed cannot be the
// nearest to any point of a box if another seed is nearer to all of the box; the plane halfway
// between the two decides that. Of the remaining seeds, in the order of cells, the last two own no
// edge there: an owner comes before both other seeds of its edge.
#pragma once

#include <cstdint>

#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Cells along each axis of the bricks for which this works.
constexpr int owning_bricks_side = 4;

/// For the 2^3 cells of an eighth of the brick whose first cell is `corner`: eight bits per cell, x
/// first. Bit i of these is set if an edge that comes near the cell may be owned by another brick.
/// That is the brick across those faces next to the cell whose axes are the bits of i. Bit 0, for
/// the brick itself, is always set. The bits of `eighth` are the axes along which it is the second
/// half. Edges come near if they come within `around` of a cell along each axis, foam units.
/// `around` plus the empty radius must be at most two cells.
uint64_t find_owning_bricks(const FoamSeeds& seeds, CellIndex corner, unsigned eighth,
                            double around);

}  // namespace msq
