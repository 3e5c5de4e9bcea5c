// SPDX-License-Identifier: Apache-2.0
// Which pieces of the boundary may bend by more than a tolerance, many at a time: the test with
// which ContourSuspects begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace msq {

struct BendLimits {
  double tolerance;
  double close;   ///< a point that is nearer than that to its neighbour tells little
  double corner;  ///< a point as far as that from the line through two others shows a corner
  double arc;     ///< arcs whose middles are nearer than that to their chords do not matter
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

/// Pieces of the boundary with points 0 and 1 before, their ends 2 and 3, and points 4 and 5
/// behind.
struct PieceBlock {
  static constexpr size_t capacity = 128;  // whole vectors
  alignas(64) double x[6][capacity], y[6][capacity];
  /// Bit i is that of piece i.
  struct Bits {
    uint64_t bends;                    ///< by more than the tolerance, or there is a corner near by
    uint64_t turns_left, turns_right;  ///< where all points say so, and corners are far
    uint64_t has_triangle;             ///< the lines beside the piece meet
    uint64_t may_be_arc;
  };
  Bits bits[capacity / 64];
};
/// Sets the bits of the first `count` pieces, and of some behind them.
void find_bends(PieceBlock& pieces, size_t count, const BendLimits& limits);

}  // namespace msq
