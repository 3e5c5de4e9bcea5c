// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/may_reach.h"

namespace msq {

bool may_reach(const Segment& s, const Box3& box, double radius) {
  const Vec3 b = s.a + s.ab;
  if (!Box3{min(s.a, b), max(s.a, b)}.overlaps(box.grown(radius * (1 + 1e-6)))) return false;
  // From the centre: this decides most segments.
  const double slack = 1e-6 * (length(s.ab) + radius + max_magnitude(box.max));
  const Vec3 centre = (box.min + box.max) * 0.5;
  const double from_centre = std::sqrt(s.distance_squared(centre));
  if (from_centre <= radius) return true;
  if (from_centre > radius + slack + 0.5 * length(box.extent()) * (1 + 1e-9)) return false;
  // The distance to a convex set is convex along a segment, so a ternary search finds its minimum.
  const auto distance_at = [&](double t) {
    const Vec3 p = s.a + s.ab * t;
    return length(p - max(box.min, min(box.max, p)));
  };
  double low = 0, high = 1;
  for (int i = 0; i < 64; ++i) {
    const double third = (high - low) / 3;
    if (distance_at(low + third) <= distance_at(high - third))
      high -= third;
    else
      low += third;
  }
  return distance_at((low + high) / 2) <= radius + slack;
}

}  // namespace msq
