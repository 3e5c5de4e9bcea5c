// SPDX-License-Identifier: Apache-2.0
// How membership and the distance to a boundary make a signed distance.
#pragma once

#include <algorithm>
#include <limits>

namespace msq {

/// Negative or 0 inside, positive outside, whatever the clearance: a lower bound of the distance to
/// the boundary that is not negative. Where the bound is 0 outside, the least normal number stands
/// for it: membership has the last word, and a host that flushes smaller numbers sees the sign too.
inline double signed_distance(bool inside, double clearance) {
  return inside ? 0.0 - clearance : std::max(clearance, std::numeric_limits<double>::min());
}

}  // namespace msq
