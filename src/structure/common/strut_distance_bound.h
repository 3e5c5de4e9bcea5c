// SPDX-License-Identifier: Apache-2.0
// Converts the onset of a strut structure to the distance to its boundary.
//
// Outside, the distance to the capsules of radius r about a graph is the distance to the graph
// minus r: exact for constant r. Inside, r minus the distance to the graph is a lower bound: the
// capsule of the nearest axis reaches that far, and other capsules may cover more. If the radius
// varies, onset - r changes by at most 1 + L times a step, L being the radius's Lipschitz constant.
// So its magnitude over 1 + L is at most the distance to where it is 0.
//
// If a field has such a constant only in boxes, that of a box about the point bounds the steps
// within the box.
#pragma once

#include <algorithm>

#include "base/infinity.h"
#include "field/field.h"

namespace msq {

/// A distance from p within which a gap stays above 0 that changes by at most own + factor L times
/// a step, L being the parameter's Lipschitz constant. At most gap / own.
inline double steady_distance(double gap, double own, double factor, const Parameter& parameter,
                              Vec3 p) {
  const double everywhere = parameter.lipschitz();
  if (everywhere < infinity || !(gap > 0)) return gap / (own + factor * everywhere);
  // The slope of a box does not include the rounding of values, there and at the boundary.
  const Interval range = parameter.range();
  gap -= factor * 0x1p-42 * std::max(std::abs(range.low), std::abs(range.high));
  if (!(gap > 0)) return 0;
  // A larger box may have a larger slope: boxes shrink from the largest that could serve until one
  // serves to at least half of its size.
  constexpr int max_boxes = 12;
  double reach = gap / own, best = 0;
  for (int n = 0; n < max_boxes; ++n) {
    const double slope =
        own + factor * parameter.lipschitz(Box3{p, p}.grown(reach * (1 + 0x1p-40)));
    best = std::max(best, std::min(reach, gap / slope));
    if (best >= 0.5 * reach) break;
    reach = std::max(0.25 * reach, best);
  }
  return best;
}

/// The distance bound of a point whose onset has an error of at most `slack`, including that of
/// inside().
inline double strut_distance_bound(double onset, double slack, const Parameter& radius, Vec3 p) {
  const Interval r = radius.range(Box3{p, p});
  const double gap = std::max(onset - r.high, r.low - onset) - slack;
  return std::max(0.0, steady_distance(gap, 1, 1, radius, p));
}

/// The same for struts whose radii differ by factors. Let f be a strut's factor. The distance to
/// the strut's axis minus f r changes by at most 1 + f L times a step. So the minimum over all
/// struts, the gap, changes by at most 1 + F L times a step, F being the largest factor. The solid
/// is where the gap is at most 0. So its magnitude over 1 + F L is at most the distance to the
/// boundary. For constant r it is exact outside, where it is the distance to the nearest capsule's
/// surface. `gap` is for the minimum radius at p; a larger radius reduces it by at most F times the
/// difference.
inline double factored_distance_bound(double gap, double max_factor, double slack,
                                      const Parameter& radius, Vec3 p) {
  const Interval r = radius.range(Box3{p, p});
  const double least = std::max(gap - max_factor * (r.high - r.low), -gap) - slack;
  return std::max(0.0, steady_distance(least, 1, max_factor, radius, p));
}

/// The step of a ray from p, where a distance is at least `bound` and the parameter may vary: the
/// bound, or `coarse` if that is more and the bound is poor, because the parameter has no slope
/// about p.
inline double steady_ray_step(double bound, double coarse, const Parameter& parameter, Vec3 p) {
  if (bound >= coarse || parameter.lipschitz() < infinity) return bound;
  return parameter.lipschitz(Box3{p, p}.grown(coarse)) < infinity ? bound : coarse;
}

/// Bound on the displacement of a point when it is located in its cell, for the point itself and
/// for a point of the boundary at `distance`: each coordinate relative to the grid's origin loses
/// about ten units of 2^-53.
inline double locating_slack(Vec3 from_origin, double distance) {
  return 0x1p-47 * (max_magnitude(from_origin) + distance);
}

}  // namespace msq
