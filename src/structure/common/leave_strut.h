// SPDX-License-Identifier: Apache-2.0
// How far a ray that is in a strut stays in it, if the radius varies along the ray.
#pragma once

#include <algorithm>

#include "base/ray.h"

namespace msq {

/// Moves `until` towards `end` by pieces, the first of which has the length `size`. follow(to)
/// moves it as far as the minimum radius between it and `to` tells, and returns whether the ray
/// leaves there for sure. The radius varies less in a shorter piece. Returns whether the ray is in
/// struts up to `end`.
template <class Follow>
bool follow_pieces(double end, double size, double tolerance, double& until, Follow&& follow) {
  constexpr int max_pieces = 64;
  constexpr double shorter = 0.125;
  for (int n = 0; n < max_pieces && until < end; ++n) {
    const double to = size < end - until ? until + size : end;
    const bool leaves = follow(to);
    if (until >= to) continue;
    if (leaves) return false;
    size *= shorter;
    if (size < tolerance) return false;
  }
  return until >= end;
}

/// Moves `until` to where the ray leaves a strut, or to `end`, if it leaves it once for sure: the
/// distance from an axis is convex along the ray, so once where it grows faster than the radius
/// can. `away`: from the axis to the ray's point at `until`. `slope`: of the radius, at most.
/// Returns whether it leaves before `end`.
template <class IsOut>
bool follow_out(Vec3 away, Vec3 direction, double slope, double end, double tolerance,
                IsOut&& is_out, double& until) {
  const double rise = dot(away, direction) / length(away);
  if (!(rise > slope) || is_out(until)) return false;
  until = is_out(end) ? std::max(until, bisect(until, end, tolerance, is_out) - tolerance) : end;
  return until < end;
}

}  // namespace msq
