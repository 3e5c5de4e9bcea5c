// SPDX-License-Identifier: Apache-2.0
// Bounds of the values of a tape over a box of positions, by interval arithmetic.
// Source: Moore, "Interval Analysis", 1966; tapes are shortened where comparisons are decided:
// Keeter, "Massively parallel rendering of complex closed-form implicit surfaces", 2020.
#pragma once

#include <vector>

#include "base/interval.h"
#include "expression/tape.h"

namespace msq {

/// Encloses the computed values of a node over a box, rounding included. If they may be infinite or
/// NaN, the ends are infinite.
using Enclosure = Interval;

inline bool is_bounded(const Enclosure& e) {
  return e.low >= -1e300 && e.high <= 1e300;
}

/// Encloses the result of an operation, computed and true, for operands from bounded enclosures.
/// `is_square`: both operands are the same node.
Enclosure enclose_result(Op op, const Enclosure& p, const Enclosure& q, bool is_square);

/// Enclosures of all nodes over a box of positions.
void enclose(const Tape& tape, const Interval (&box)[3], std::vector<Enclosure>& nodes);

/// The tape without the minima, maxima, magnitudes, floors, comparisons and selections that the
/// enclosures decide: the same bits throughout the box.
Tape shortened(const Tape& tape, const std::vector<Enclosure>& nodes);

}  // namespace msq
