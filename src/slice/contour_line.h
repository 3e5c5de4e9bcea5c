// SPDX-License-Identifier: Apache-2.0
// Rings with no more points than the tolerance needs.
//
// The boundary crosses edges of the grid one by one. About each crossing lies a gate: the part of
// its edge within the tolerance of the crossing, and a margin away from both nodes. A segment may
// replace a part of the boundary if it passes all gates of that part, each with the gate's node
// inside on its left. From a point on, the directions that pass all gates so far form a cone; the
// segment ends at the last point that the cone holds (Imai and Iri, "An optimal algorithm for
// approximating a piecewise linear function", 1986, do so for functions).
//
// Why rings stay simple and apart: a segment that passes the gates runs through the same cells as
// the boundary, in the same order, since cells are convex. In each cell at most one piece of one
// ring connects two edges; the two pieces of a saddle keep to either side of a diagonal. Gates end
// a margin away from nodes, so pieces stay a margin away from edges that they do not cross, and
// away from other pieces. Rounding that moves points by less than half a margin makes none of them
// meet.
#pragma once

#include <cstddef>
#include <cstdint>

#include "slice/contour_gates.h"

namespace msq {

/// A part of a ring: from a point that stays, by crossings, to the point where the next part
/// begins.
struct LineRun {
  Vec2 from;
  uint32_t first, end;  ///< of the crossings between
};

/// Writes the points of a closed ring that remain, multiplied by `units`: no more than there are.
/// Returns their number. The last run leads to the first one. `at`, `gates`: of the crossings.
size_t simplify_ring(const LineRun* runs, size_t count, const Vec2* at, const LineGate* gates,
                     double units, Vec2* out);

}  // namespace msq
