// SPDX-License-Identifier: Apache-2.0
// Where the crossings of rings lie, and the gates about these (contour_line.h), in vectors.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vec2.h"
#include "slice/contour_ring_kind.h"

namespace msq {

/// Crossings one after the other.
struct RingCrossings {
  const uint64_t* cells;  ///< that follow them: the column, and the row in the upper 32 bits
  const uint8_t* kinds;
  size_t count;
};

/// Nodes of the lattice between the edges of the window.
struct RingNodes {
  double first_u, first_v, pitch;
  uint32_t first_column, first_row;
  double margin;  ///< that crossings and gates keep from nodes
};

/// The ends of a crossing's gate as seen by who walks with the inside on the left.
struct LineGate {
  double left_x, right_x, left_y, right_y;
};

/// From u or v of crossings (see ContourSection::ends()) finds x and y, for edges between nodes of
/// the lattice. What it writes for others has no meaning. Writes up to max_simd_doubles elements
/// beyond the count, and reads as many.
void place_crossings(const RingCrossings& crossings, const RingNodes& nodes, const double* ends,
                     double* x, double* y);

/// Copies the places of crossings and finds their gates: what lies within `tolerance` of them on
/// their edges. Reads and writes as place_crossings() does.
void find_gates(const RingCrossings& crossings, const RingNodes& nodes, const double* x,
                const double* y, double tolerance, Vec2* at, LineGate* gates);

}  // namespace msq
