// SPDX-License-Identifier: Apache-2.0
// Rounding of coordinates to whole units, to the nearest and halves to even, as std::nearbyint()
// does; that is a call where the instruction is not known to exist.
#pragma once

#include <cmath>

namespace msq {

inline double nearest_unit(double x) {
  // Numbers from 2^52 on are whole.
  constexpr double shift = 0x1.8p52;
  return std::abs(x) < 0x1p51 ? (x + shift) - shift : std::nearbyint(x);
}

}  // namespace msq
