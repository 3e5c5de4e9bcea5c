// SPDX-License-Identifier: Apache-2.0
// From the onset of a strut structure to the distance to its boundary.
//
// Outside, the distance to the capsules of radius r about a graph is the distance to the graph less
// r: exact for constant r. Inside, r less the distance to the graph is a lower bound: the nearest
// axis's capsule reaches that far, and others may cover more. With a radius that varies, onset - r
// changes by no more than 1 + L times a step, L being the radius's Lipschitz constant; so its
// magnitude over 1 + L is no more than the distance to where it is 0.
#pragma once

#include <algorithm>

#include "field/field.h"

namespace msq {

/// The clearance of a point whose onset is known within `slack`, that of inside() included.
inline double strut_clearance(double onset, double slack, const Parameter& radius, Vec3 p) {
  const Interval r = radius.range(Box3{p, p});
  const double gap = std::max(onset - r.high, r.low - onset) - slack;
  return std::max(0.0, gap / (1 + radius.lipschitz()));
}

/// What locating a point in its cell may move it by, there and at a point of the boundary that is
/// `distance` away: each of its coordinates from the grid's origin on loses about ten units of
/// 2^-53.
inline double locating_slack(Vec3 from_origin, double distance) {
  return 0x1p-47 * (max_magnitude(from_origin) + distance);
}

}  // namespace msq
