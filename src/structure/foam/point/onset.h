// SPDX-License-Identifier: Apache-2.0
// The onset of foams: the distance from a point to the nearest point of any Voronoi edge.
//
// Which seeds matter to the edges within R of a point q: let s0 be its nearest seed, at distance
// d0. As in point.cpp, only those within d0 + 2 R matter. Of these, a seed s matters only if the
// plane between it and s0 is within R of q. Otherwise the ball of radius R about q lies on the side
// of s0. Then no edge of s meets the ball, and s0 cuts away everything in the ball that s would. R
// begins small, and grows until an edge is found within it; that edge is then the nearest.
#pragma once

#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Maximum error of an onset, in foam units. The error of an edge's line is at most 4 units of
/// 2^-53 times the radius of its circle over the triangle's shortest side. 1e-9 covers seeds down
/// to 1e-5 of a cell from each other, and the tolerances of EdgeLine.
constexpr double onset_slack = 1e-9;

/// In a foam with one seed per unit of volume, most points are within this distance of an edge.
constexpr double first_onset_radius = 0.25;

/// Onset of q (foam units, from the corner of `cell`), in foam units.
double foam_onset(const FoamSeeds& seeds, CellIndex cell, Vec3 q);

/// Distance from q to the nearest edge of some seeds if it is at most `radius`, otherwise infinity.
/// The seeds include those that matter within the radius, in the order of seeds. The unit of length
/// must suit EdgeLine's tolerances.
double edge_within(const std::vector<Vec3>& seeds, Vec3 q, double radius);

/// The same with growing radii: first, 2 first, 4 first ... until one suffices; at least `most` if
/// none up to `most` does. gather(radius) returns the seeds for that radius.
template <class Gather>
double nearest_edge(Vec3 q, double first, double most, Gather&& gather) {
  for (double radius = first;; radius *= 2) {
    const double found = edge_within(gather(radius), q, radius);
    if (found <= radius) return found;
    if (radius >= most) return radius;
  }
}

}  // namespace msq
