// SPDX-License-Identifier: Apache-2.0
// The line of an edge of a power diagram (seeds/seeds.h): the points at which three seeds have
// equal power. Edges, chords and cuts are those of edge_line.h with lifted distances.
//
// Relative to the seed a, the points x at which a and a + u have equal power are those with u . x =
// (|u|^2 + l) / 2, l being the lift of a + u less that of a; in edge_line.h l is 0.
#pragma once

#include "structure/foam/point/edge_line.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

struct WeightedLine {
  EdgeLine line;  ///< only its cut() is not that of the edge
  double lift;    ///< of the first seed

  /// Seeds in ascending order of their cells.
  WeightedLine(const LiftedSeed& a, const LiftedSeed& b, const LiftedSeed& c) : lift(a.lift) {
    const Vec3 u = b.place - a.place, v = c.place - a.place;
    line.seed = a.place;
    line.direction = cross(u, v);
    const double squared = dot(line.direction, line.direction);
    line.inverse_squared = squared > 0 ? 1 / squared : 0;
    const double to_u = dot(u, u) + (b.lift - a.lift), to_v = dot(v, v) + (c.lift - a.lift);
    line.offset = cross(v * to_u - u * to_v, line.direction) * (0.5 * line.inverse_squared);
  }

  bool exists() const { return line.exists(); }
  LineInterval chord(Vec3 centre, double radius_squared) const {
    return line.chord(centre, radius_squared);
  }
  Vec3 way_from(LineInterval part, Vec3 to) const { return line.way_from(part, to); }
  bool holds(LineInterval part) const { return line.holds(part); }

  /// Cuts off the part where another seed has less power than the line's own three.
  void cut(const LiftedSeed& other, LineInterval& part) const {
    const Vec3 e = other.place - line.seed;
    const double across = dot(line.direction, e);
    const double room = 0.5 * (dot(e, e) + (other.lift - lift)) - dot(line.offset, e);
    if (across > EdgeLine::coplanar)
      part.high = std::min(part.high, room / across);
    else if (across < -EdgeLine::coplanar)
      part.low = std::max(part.low, room / across);
    else if (room < -EdgeLine::cocircular)
      part = no_part;
  }
};

}  // namespace msq
