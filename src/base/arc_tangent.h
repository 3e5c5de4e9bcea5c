// SPDX-License-Identifier: Apache-2.0
// The arc tangent from IEEE additions, products and quotients alone. Its bits are the same on every
// instruction set; those of the C library depend on its version and on the machine.
//
// atan(q) = atan(c) + atan((q - c) / (1 + q c)), where c is the multiple of 1/8 nearest to q. The
// second argument is at most 1/16. There the remainder of the Taylor series after r^13 is below
// r^15 / 15 < 2^-63.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/pi.h"

namespace msq {

/// The angle of the vector (x, y), from -pi to pi, with the signs of zeros of std::atan2(y, x). x
/// and y are finite and their product does not overflow. The error is below 2^-50.
inline double arc_tangent(double y, double x) {
  static constexpr double at_eighths[] = {0,
                                          0.12435499454676144,
                                          0.24497866312686414,
                                          0.35877067027057225,
                                          0.46364760900080615,
                                          0.5585993153435624,
                                          0.6435011087932844,
                                          0.7188299996216245,
                                          0.7853981633974483};
  double low = std::abs(y), high = std::abs(x);
  const bool is_steep = low > high;
  if (is_steep) std::swap(low, high);
  double angle = 0;
  if (high > 0) {
    const double eighths = std::floor(low / high * 8 + 0.5);
    const double c = eighths * 0.125;
    const double r = (low - c * high) / (high + c * low), s = r * r;
    // r - r^3 / 3 + ... + r^13 / 13
    double tail = 1.0 / 13;
    for (const double term : {-1.0 / 11, 1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3})
      tail = term + s * tail;
    angle = at_eighths[static_cast<size_t>(eighths)] + (r + r * s * tail);
  }
  if (is_steep) angle = 0.5 * pi - angle;
  if (std::signbit(x)) angle = pi - angle;
  return std::copysign(angle, y);
}

}  // namespace msq
