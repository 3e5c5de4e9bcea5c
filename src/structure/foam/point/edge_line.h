// SPDX-License-Identifier: Apache-2.0
// The line of a Voronoi edge, and the one test that decides foam membership on every path.
//
// The points equally far from three seeds a, b, c form a line: through the circumcentre of their
// triangle, along its normal. The Voronoi edge of the triple is the part of the line where no other
// seed is nearer; it may be empty. The ball of radius r about a point p cuts a chord from the line.
// p lies in the foam if, for some triple, that chord meets that part. This is the capsule solid:
// struts are round at their ends, since near the end of an edge the chord is cut by the seed that
// ends it. (Martinez, Dumas and Lefebvre 2016 test the foot of the perpendicular instead, and only
// for the nearest seed's edges. That gives flat-ended cylinders that are cut at cell faces.)
//
// All paths order the triple in the same way, work in the frame of the cell that contains p, and
// form minimum and maximum over cuts. These do not depend on the order of cuts or on cuts that do
// not bind. So all paths agree bit for bit, even if they find the relevant seeds in different ways.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.h"

namespace msq {

/// A part of a line, by the line's parameter; empty if low > high.
struct LineInterval {
  double low, high;
};
/// More empty than any tolerance accepts.
constexpr LineInterval no_part{std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};

struct EdgeLine {
  Vec3 seed;                   // one of the three seeds
  Vec3 offset;                 // from it to the circumcentre
  Vec3 direction;              // normal of the triangle; its length is twice the area
  double inverse_squared = 0;  // of direction

  EdgeLine() = default;
  /// Seeds in ascending order of their cells (z, then y, then x).
  EdgeLine(Vec3 a, Vec3 b, Vec3 c) : seed(a) {
    const Vec3 u = b - a, v = c - a;
    direction = cross(u, v);
    const double squared = dot(direction, direction);
    inverse_squared = squared > 0 ? 1 / squared : 0;
    offset = cross(v * dot(u, u) - u * dot(v, v), direction) * (0.5 * inverse_squared);
  }

  /// False for collinear seeds, which have no line.
  bool exists() const { return inverse_squared > 0; }
  Vec3 at(double t) const { return seed + offset + direction * t; }

  /// The chord within a ball.
  LineInterval chord(Vec3 centre, double radius_squared) const {
    const Vec3 w = centre - seed - offset;
    const double foot = dot(w, direction) * inverse_squared;
    const Vec3 d = w - direction * foot;
    const double under = (radius_squared - dot(d, d)) * inverse_squared;
    if (under < 0) return no_part;
    const double half = std::sqrt(under);
    return {foot - half, foot + half};
  }

  /// The vector to a point from the nearest point of a part of the line.
  Vec3 way_from(LineInterval part, Vec3 to) const {
    const Vec3 w = to - seed - offset;
    const double foot = dot(w, direction) * inverse_squared;
    return w - direction * std::max(part.low, std::min(part.high, foot));
  }

  /// Cuts off the part where another seed is nearer than the line's own three.
  void cut(Vec3 other, LineInterval& part) const {
    const Vec3 e = other - seed;
    const double across = dot(direction, e);
    const double room = 0.5 * dot(e, e) - dot(offset, e);  // > 0: not nearer to the circumcentre
    if (across > coplanar)
      part.high = std::min(part.high, room / across);
    else if (across < -coplanar)
      part.low = std::max(part.low, room / across);
    else if (room < -cocircular)
      part = no_part;
  }

  /// Half of how much another seed's squared distance from a point exceeds that of the line's own
  /// three seeds. The point is that of the line nearest to `to`.
  double lead(Vec3 other, Vec3 to) const {
    const Vec3 e = other - seed;
    const double foot = dot(to - seed - offset, direction) * inverse_squared;
    return 0.5 * dot(e, e) - dot(offset + direction * foot, e);
  }

  /// Whether a part is not empty. Seeds on one sphere (low jitter) make edges of length zero that
  /// rounding may invert. A part that is inverted by at most 1e-12 counts: it lies that close to
  /// edges that do exist.
  bool holds(LineInterval part) const {
    const double gap = part.low - part.high;
    return gap <= 0 || gap * gap <= forgiven_squared * inverse_squared;
  }

  // The tolerance of the definition, for code that tests many lines at once.
  static constexpr double forgiven_squared = 1e-24;
  // The distance of a fourth seed in the plane of the three to the line is constant along it; on
  // their circle it cuts nothing. Both are decided with a tolerance for rounding, which would
  // otherwise cut such lines anywhere.
  static constexpr double coplanar = 1e-14, cocircular = 1e-12;
};

}  // namespace msq
