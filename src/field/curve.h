// SPDX-License-Identifier: Apache-2.0
// A piecewise linear function of one number, constant beyond its ends.
#pragma once

#include <cstddef>
#include <vector>

#include "base/interval.h"

namespace msq {

class Curve {
 public:
  struct Knot {
    double at, value;
  };
  /// At least one knot, `at` ascending; no difference of neighbours overflows.
  explicit Curve(std::vector<Knot> knots);

  /// As computed, it runs one way between neighbouring knots and passes through them.
  double operator()(double v) const;
  /// Exactly the least and the greatest value over an interval, which may be infinite.
  Interval range(Interval over) const;
  /// No two values differ by more than this times the difference of where they are taken, but for
  /// rounding.
  double lipschitz() const { return lipschitz_; }
  /// The same of values in an interval.
  double lipschitz(Interval over) const;

 private:
  /// Of the piece that ends at knot i.
  double slope_to(size_t i) const;
  /// Number of knots at or below v.
  size_t knots_to(double v) const;

  std::vector<Knot> knots_;
  double lipschitz_ = 0;
};

}  // namespace msq
