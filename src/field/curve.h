// SPDX-License-Identifier: Apache-2.0
// A piecewise linear function of one number, constant beyond its ends.
#pragma once

#include <cstddef>
#include <vector>

#include "base/hash_input.h"
#include "base/interval.h"

namespace msq {

class Curve {
 public:
  struct Knot {
    double at, value;
  };
  /// At least one knot, `at` ascending; no difference of neighbours overflows.
  explicit Curve(std::vector<Knot> knots);

  /// Computed values are monotone between neighbouring knots and pass through the knots.
  double operator()(double v) const;
  /// The exact minimum and maximum over an interval, which may be infinite.
  Interval range(Interval over) const;
  /// Lipschitz constant: two values differ by at most this times the difference of their arguments,
  /// plus rounding.
  double lipschitz() const { return lipschitz_; }
  /// The same for arguments in an interval.
  double lipschitz(Interval over) const;
  /// Bounds of the difference of two values over that of their arguments, from an interval, without
  /// rounding. The ends may be infinite.
  Interval slopes(Interval over) const;
  void describe(HashInput& input) const;

 private:
  /// The steepness of the piece that ends at knot i.
  double slope_to(size_t i) const;
  /// Number of knots at or below v.
  size_t knots_to(double v) const;

  std::vector<Knot> knots_;
  double lipschitz_ = 0;
};

}  // namespace msq
