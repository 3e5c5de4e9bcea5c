// SPDX-License-Identifier: Apache-2.0
// Directions of vectors of any length.
#pragma once

#include "base/vec.h"

namespace msq {

/// The vector of length 1 along `a`, whose length may be too small or too large to be squared; 0 if
/// `a` is 0, or is not finite.
inline Vec3 unit_along(Vec3 a) {
  double size = length(a);
  if (!(size > 0x1p-500 && size < 0x1p500)) {
    const double most = max_magnitude(a);
    if (!(most > 0 && is_finite(a))) return {};
    a = {a.x / most, a.y / most, a.z / most};
    size = length(a);
  }
  return a * (1 / size);
}

}  // namespace msq
