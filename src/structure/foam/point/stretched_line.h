// SPDX-License-Identifier: Apache-2.0
// The line of a Voronoi edge of a stretched foam (seeds/stretch.h): the same line in two spaces, by
// one parameter. Which seeds are nearest is decided in the space of the diagram, distances are
// those of model space.
#pragma once

#include "structure/foam/point/edge_line.h"

namespace msq {

struct StretchedLine {
  EdgeLine of_diagram;  ///< diagram units
  EdgeLine of_foam;     ///< foam units

  /// Seeds in diagram units, in ascending order of their cells. factor: of Stretch.
  StretchedLine(Vec3 factor, Vec3 a, Vec3 b, Vec3 c) : of_diagram(a, b, c) {
    of_foam.seed = of_diagram.seed * factor;
    of_foam.offset = of_diagram.offset * factor;
    of_foam.direction = of_diagram.direction * factor;
    const double squared = dot(of_foam.direction, of_foam.direction);
    of_foam.inverse_squared = of_diagram.exists() && squared > 0 ? 1 / squared : 0;
  }

  bool exists() const { return of_foam.exists(); }
  /// As EdgeLine: points in foam units, seeds in diagram units.
  LineInterval chord(Vec3 centre, double radius_squared) const {
    return of_foam.chord(centre, radius_squared);
  }
  Vec3 way_from(LineInterval part, Vec3 to) const { return of_foam.way_from(part, to); }
  void cut(Vec3 other, LineInterval& part) const { of_diagram.cut(other, part); }
  bool holds(LineInterval part) const { return of_diagram.holds(part); }
};

}  // namespace msq
