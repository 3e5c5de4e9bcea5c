// SPDX-License-Identifier: Apache-2.0
// Which bricks may own the edges that come near the cells of a brick.
//
// By the empty radius alone, owners of edges (edges.h) may lie two cells (cubes) from a point near
// them. That far they are rarely: here the seeds themselves tell. All three seeds of an edge are
// nearest seeds of its points. A cell, grown, is cut into boxes. A seed is left out of those that
// may be the nearest to a point of a box if another is nearer to all of the box, which the plane
// halfway between the two decides. Of the seeds that are left, in the order of cells, the last two
// own no edge there: an owner comes before both others of its edge.
#pragma once

#include <array>
#include <cstdint>

#include "structure/foam/seed_block.h"

namespace msq {

/// Cells along each axis of the bricks that this is for.
constexpr int owning_bricks_side = 4;
/// For each cell, x first: bit i tells whether an edge that comes near the cell may be owned by the
/// brick across those of the faces next to the cell whose axes are bits of i. Bit 0, for the brick
/// itself, is set.
using OwningBricks =
    std::array<uint8_t, owning_bricks_side * owning_bricks_side * owning_bricks_side>;

/// For edges that come within `around` of a cell along each axis, foam units, where that and the
/// empty radius together are no more than two cells.
OwningBricks find_owning_bricks(const SeedBlock& block, Vec3 scale, double around);

}  // namespace msq
