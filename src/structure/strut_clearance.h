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

/// The same of struts whose radii differ by factors. Each strut's distance less f r, f its factor,
/// changes by no more than 1 + f L times a step, and so does the least of them by 1 + F L, F being
/// the greatest factor; the solid is where that least, the gap, is at most 0. So its magnitude over
/// 1 + F L is no more than the distance to the boundary: for constant r exact outside, where the
/// nearest capsule's surface is that far. `gap`: for the least radius that r allows at the point; a
/// greater one leaves it less by F times the difference at most.
inline double factored_clearance(double gap, Interval r, double most_factor, double slack,
                                 double lipschitz) {
  const double least = std::max(gap - most_factor * (r.high - r.low), -gap) - slack;
  return std::max(0.0, least / (1 + most_factor * lipschitz));
}

/// What locating a point in its cell may move it by, there and at a point of the boundary that is
/// `distance` away: each of its coordinates from the grid's origin on loses about ten units of
/// 2^-53.
inline double locating_slack(Vec3 from_origin, double distance) {
  return 0x1p-47 * (max_magnitude(from_origin) + distance);
}

}  // namespace msq
