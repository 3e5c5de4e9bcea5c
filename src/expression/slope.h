// SPDX-License-Identifier: Apache-2.0
// Proven bounds of the slope of a tape over a box, and of the error of computed values, by
// enclosures of the gradient and of rounding.
// Source: Moore, "Interval Analysis", 1966; Griewank and Walther, "Evaluating Derivatives", 2008
// (forward mode). The maximum slope is found by bisection of the boxes that may contain it.
#pragma once

#include <array>
#include <optional>

#include "base/interval.h"
#include "base/vec.h"
#include "expression/tape.h"

namespace msq {

/// Bounds for the function that a tape stands for in exact arithmetic, over a box. They are
/// infinite if nothing is known: where floors, comparisons, selections or angles jump, near poles,
/// and roots and logarithms of arguments that may reach 0.
struct Slope {
  /// The values of two points differ by at most this times their distance, where each coordinate's
  /// difference is multiplied by 1 / scale.
  double most;
  /// Maximum difference between the evaluator's values and the function's, if the error of the
  /// evaluator's coordinates is at most coordinate_error.
  double error;
};

Slope bound_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale, double coordinate_error);

/// The same from one enclosure, for small boxes: takes microseconds instead of milliseconds.
Slope enclose_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale,
                    double coordinate_error);

/// Over a box: enclosures of the function's values and of its derivatives along each axis, and the
/// error as above, for exact coordinates.
struct Derivatives {
  Interval value;
  std::array<Interval, 3> along;
  double error;
};

/// From one enclosure, for small boxes: takes microseconds. Empty if something is unbounded.
std::optional<Derivatives> enclose_derivatives(const Tape& tape, const Interval (&box)[3]);

}  // namespace msq
