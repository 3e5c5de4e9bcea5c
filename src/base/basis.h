// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "base/vec.h"

namespace msq {

/// Two unit vectors normal to a unit vector and to each other.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
inline void complete_basis(Vec3 n, Vec3& a, Vec3& b) {
  const double sign = std::copysign(1.0, n.z);
  const double f = -1 / (sign + n.z), g = n.x * n.y * f;
  a = {1 + sign * n.x * n.x * f, sign * g, -sign * n.x};
  b = {g, sign + n.y * n.y * f, -n.y};
}

}  // namespace msq
