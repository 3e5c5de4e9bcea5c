// SPDX-License-Identifier: Apache-2.0
// How fast the value of a tape changes over a box, and how far computed values are from it: proven
// bounds, by enclosures of the gradient and of rounding.
// Source: Moore, "Interval Analysis", 1966; Griewank and Walther, "Evaluating Derivatives", 2008
// (forward mode); the greatest slope by bisection of the boxes that may hold it.
#pragma once

#include "base/interval.h"
#include "base/vec.h"
#include "expression/tape.h"

namespace msq {

/// Of the function that a tape stands for in exact arithmetic, over a box. Infinite where nothing
/// is known: about jumps, poles, and roots and logarithms that may reach 0.
struct Slope {
  /// Two points' values differ by no more than this times their distance, each coordinate counting
  /// for 1 / scale of its difference.
  double most;
  /// The evaluator's values differ from the function's by no more, if its coordinates are wrong by
  /// no more than coordinate_error.
  double error;
};

Slope bound_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale, double coordinate_error);

/// The same from one enclosure, microseconds instead of milliseconds of work: for small boxes.
Slope enclose_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale,
                    double coordinate_error);

}  // namespace msq
