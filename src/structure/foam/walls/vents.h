// SPDX-License-Identifier: Apache-2.0
// Holes through the middle of walls.
//
// The wall between the seeds a and b is there where their face has an area. Its hole is the
// cylinder about the line through the centroid of the face, along a - b. A wall whose face has less
// area than the circle of its hole has none, nor has one whose hole would be smaller than
// min_vent_radius. A hole is of its own wall only: where another wall holds a point, the point is
// solid.
#pragma once

#include <limits>

#include "field/field.h"
#include "structure/foam/walls/near_seeds.h"
#include "structure/foam/walls/wall_face.h"
#include "structure/foam/walls/wall_point.h"

namespace msq {

/// Smaller holes are none.
constexpr double min_vent_radius = 0x1p-9;
/// How far the axis of a hole of some radius may be off. Lines that bound the face are off by 2^-53
/// over the distance of two seeds, for which there is room down to 1e-6; the centroid is a quotient
/// by the area.
inline double vent_error(double radius) {
  return 1e-10 + 4e-15 / (radius * radius);
}
/// Of the face of a wall that has a hole of some radius, at least.
inline double vent_area(double radius) {
  return 3.14159265358979323846 * radius * radius;
}

/// A wall near a point. Foam units, from the corner of a cell.
struct VentedWall {
  bool is_there = false;
  double radius = 0;   ///< of the hole; 0: none
  Vec3 middle, along;  ///< of the hole's axis; the latter of length 1

  /// How deep a point is in the hole; negative outside it, by the distance to it.
  double depth(Vec3 q) const {
    if (!(radius > 0)) return -std::numeric_limits<double>::infinity();
    const Vec3 from = q - middle;
    return radius - length(from - along * dot(from, along));
  }
};

class Vents {
 public:
  /// `unit`: of foams, in model units, as the radius is.
  Vents(const Neighbourhood& grid, double unit, Parameter radius)
      : grid_(grid), unit_(unit), radius_(std::move(radius)) {}

  bool exist() const { return max_radius() >= min_vent_radius; }
  const Parameter& radius() const { return radius_; }
  /// Foam units.
  double max_radius() const { return radius_.range().high / unit_; }

  /// The wall between two seeds, as NearSeeds::find() finds them near points of a cell.
  VentedWall wall(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b) const;

 private:
  const Neighbourhood grid_;
  const double unit_;
  const Parameter radius_;
};

/// As is_in_wall() and find_nearest_face() (wall_point.h), with holes: a wall counts where its hole
/// does not hold q.
bool is_in_vented_wall(const NearSeeds& seeds, const Vents& vents, CellIndex cell, Vec3 q,
                       double thickness);
/// `limit`, in foam units: walls whose onset is above it are not sought, since a point in the holes
/// of all near walls would look at many.
NearFace find_nearest_vented_face(const NearSeeds& seeds, const Vents& vents, CellIndex cell,
                                  Vec3 q, double limit);

}  // namespace msq
