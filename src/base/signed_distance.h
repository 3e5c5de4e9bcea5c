// SPDX-License-Identifier: Apache-2.0
// Combines membership and the distance to a boundary into a signed distance.
#pragma once

#include <algorithm>
#include <limits>

namespace msq {

/// Negative or 0 inside, positive outside, for any distance bound. distance bound is a non-negative
/// lower bound on the distance to the boundary. If it is 0 outside, the smallest normal number
/// replaces it. So the sign always agrees with membership, also in a host that flushes smaller
/// numbers.
inline double signed_distance(bool inside, double distance_bound) {
  return inside ? 0.0 - distance_bound
                : std::max(distance_bound, std::numeric_limits<double>::min());
}

}  // namespace msq
