// SPDX-License-Identifier: Apache-2.0
// What a tape can be over a box of positions, by interval arithmetic.
// Source: Moore, "Interval Analysis", 1966; shortening of tapes where comparisons are decided:
// Keeter, "Massively parallel rendering of complex closed-form implicit surfaces", 2020.
#pragma once

#include <vector>

#include "base/interval.h"
#include "expression/tape.h"

namespace msq {

/// Encloses the computed values, rounding included, of a node over a box. Where they may be
/// infinite or no number, the ends are infinite.
using Enclosure = Interval;

inline bool is_bounded(const Enclosure& e) {
  return e.low >= -1e300 && e.high <= 1e300;
}

/// Encloses what an operation gives, and its true value, for operands from bounded enclosures.
/// `is_square`: both operands are the same node.
Enclosure enclose_result(Op op, const Enclosure& p, const Enclosure& q, bool is_square);

/// Enclosures of all nodes over a box of positions.
void enclose(const Tape& tape, const Interval (&box)[3], std::vector<Enclosure>& nodes);

/// The tape with the minima, maxima and magnitudes left out that the enclosures decide: the same
/// bits throughout the box.
Tape shortened(const Tape& tape, const std::vector<Enclosure>& nodes);

}  // namespace msq
