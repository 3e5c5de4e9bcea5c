// SPDX-License-Identifier: Apache-2.0
// The definition of walls, which every other way agrees with.
//
// Let a be the seed nearest to a point p. For another seed b, half of
//
//   (|p - b|^2 - |p - a|^2) / |a - b|
//
// is the distance from p to the plane between a and b. The Voronoi cell of a is convex and bounded
// by such planes, and no other of them cuts it. So the least over all b is twice the distance from
// p to the nearest face of any cell: the thickness of the thinnest walls that hold p. Walls of
// thickness t hold p where it is at most t.
//
// Which seeds matter. As |a - b| <= |p - a| + |p - b|, the quotient is at least |p - b| - |p - a|:
// it is more than t for all seeds that are farther from p than a is by more than t.
//
// If cells are stretched, a, b and p are in the space of the diagram (seeds/stretch.h), and the
// plane is moved back to model space: the divisor becomes |(a - b) / factor|. That is at most |a -
// b| over the least factor, so seeds matter that are farther by up to t over the least factor.
//
// If seeds have weights (seeds/seeds.h), all of this holds of lifted distances: the cells of a
// power diagram are convex, and |a - b| is no more than the distance of the lifted seeds. The
// divisor stays |a - b|, since the plane of equal power is normal to a - b.
//
// The quotient is computed as n . ((a - p) + (b - p)), n being the unit vector from a to b. So it
// carries a few roundings of the distances, however near to each other a and b are. With weights,
// the difference of the lifts over |a - b| comes on top.
#pragma once

#include <cmath>
#include <limits>

#include "structure/foam/walls/near_seeds.h"

namespace msq {

/// A face near a point. Lengths in foam units.
struct NearFace {
  double onset = std::numeric_limits<double>::infinity();  ///< twice the distance to it
  Vec3 across{};  ///< from the seed nearest to the point to the other
};

/// Twice the distance from q to the plane between a and b; negative on the side of b.
inline double plane_onset(Vec3 a, Vec3 b, Vec3 q) {
  const Vec3 apart = b - a;
  return dot(apart, (a - q) + (b - q)) / length(apart);
}

/// The number of the seed nearest to q, the first of several.
size_t nearest_of(const std::vector<Vec3>& seeds, Vec3 q);
/// The same by lifted distances.
size_t nearest_of(const std::vector<LiftedSeed>& seeds, Vec3 q);
/// The nearest face, among some of the seeds that hold the one nearest to q.
NearFace nearest_face(const NearSeeds& seeds, const std::vector<Vec3>& near, Vec3 q);

/// Whether walls of a thickness hold q, in the space of the diagram, from the corner of `cell`.
bool is_in_wall(const NearSeeds& seeds, CellIndex cell, Vec3 q, double thickness);
/// The face nearest to q; its onset is the least thickness for which is_in_wall().
NearFace find_nearest_face(const NearSeeds& seeds, CellIndex cell, Vec3 q);

}  // namespace msq
