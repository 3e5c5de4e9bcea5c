// SPDX-License-Identifier: Apache-2.0
// Which pieces of the boundary may bend by more than a tolerance, many at a time: the test with
// which ContourDetails begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace msq {

struct BendLimits {
  double tolerance;
  double close;   ///< a point that is nearer than that to its neighbour tells little
  double corner;  ///< a point as far as that from the line through two others shows a corner
};

/// Sets bit i of `bits` where the boundary may bend by more than the tolerance between point i and
/// the next one, as points i - 2 to i + 3 tell; also beside points that are close and beside
/// corners, which may hide others, and at some pieces near both ends of the points. Writes the
/// words of `count` bits.
void find_bends(const double* x, const double* y, size_t count, const BendLimits& limits,
                uint64_t* bits);

/// Points that form a ring.
struct RingPoints {
  uint32_t first, end;
};
/// Sets or clears the bits near both ends of rings, where find_bends() took points of other rings.
void find_bends_at_ends(const double* x, const double* y, std::span<const RingPoints> rings,
                        const BendLimits& limits, uint64_t* bits);

}  // namespace msq
