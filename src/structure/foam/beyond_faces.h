// SPDX-License-Identifier: Apache-2.0
// Which cells of a brick need the edges of the bricks next to it.
//
// By the empty radius alone, owners of edges (edges.h) may lie two cells (cubes) from a point near
// them. That far they are rarely: here the seeds themselves tell. A cell, grown, is cut into boxes.
// If for each box some seed is nearer to all of it than every seed beyond a face of the brick,
// which the planes halfway between seeds decide, no point of the cell has its nearest seed there,
// and no edge that comes near is owned from there.
#pragma once

#include <array>
#include <cstdint>

#include "structure/foam/seed_block.h"

namespace msq {

/// Cells along each axis of the bricks that this is for.
constexpr int beyond_faces_side = 4;
/// For each cell, x first: bit `axis` tells whether a point near the cell may have its nearest seed
/// beyond that of the two faces across the axis which is next to the cell.
using BeyondFaces = std::array<uint8_t, beyond_faces_side * beyond_faces_side * beyond_faces_side>;

/// For points within `around` of a cell along each axis, foam units. Cells at a face are taken to
/// need what is beyond it.
BeyondFaces find_beyond_faces(const SeedBlock& block, Vec3 scale, double around);

}  // namespace msq
