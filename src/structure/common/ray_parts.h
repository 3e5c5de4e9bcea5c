// SPDX-License-Identifier: Apache-2.0
// The parts of a ray in a region that cells fill: a shell, or a box. A ray meets a shell in two
// parts at most.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/infinity.h"
#include "base/ray.h"

namespace msq {

struct RayPart {
  double from, to;  ///< points in the region
  bool is_entry;    ///< whether the ray enters the region at `from`
};
struct RayParts {
  RayPart part[2];
  size_t count = 0;
};

/// Moves an end of a part, which rounding may have put outside of the region, towards `end`, until
/// holds(t): at most `tolerance` past the change. Infinite, away from `end`, if no point of the
/// region is found.
template <class Holds>
double settle_end(double t, double end, double tolerance, Holds&& holds) {
  if (holds(t)) return t;
  const double sign = end < t ? -1 : 1;
  for (double step = 0.25 * tolerance; t != end; step *= 2) {
    const double next = sign > 0 ? std::min(end, t + step) : std::max(end, t - step);
    if (holds(next))
      return sign *
             bisect(sign * t, sign * next, tolerance, [&](double s) { return holds(sign * s); });
    t = next;
  }
  return sign * infinity;
}

/// A t up to `end` up to which holds(t), from a point of the region on that is the end of a part up
/// to rounding.
template <class Holds>
double follow_part(double t, double end, double tolerance, Holds&& holds) {
  for (double step = 0.25 * tolerance; t < end && holds(t); step *= 2) t = std::min(end, t + step);
  return t;
}

/// Adds what [first, last] and [from, to] have in common.
template <class Holds>
void add_part(RayParts& parts, double first, double last, double from, double to, double tolerance,
              Holds&& holds) {
  const double a = std::max(first, from), b = std::min(last, to);
  if (!(a <= b)) return;
  const RayPart part{settle_end(a, b, tolerance, holds), settle_end(b, a, tolerance, holds),
                     first > from};
  if (part.from <= part.to) parts.part[parts.count++] = part;
}

}  // namespace msq
