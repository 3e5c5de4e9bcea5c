// SPDX-License-Identifier: Apache-2.0
// The onset of foams: the distance from a point to the nearest point of any Voronoi edge.
//
// Which seeds matter to the edges within R of a point q: let s0 be its nearest seed, at d0. As in
// point.cpp, those within d0 + 2 R alone. Of these, a seed s matters only if the plane between it
// and s0 is within R of q: otherwise the ball of radius R about q lies on the side of s0, so no
// edge of s meets the ball, and what s would cut away in the ball, s0 cuts away too. R begins
// small, and grows until an edge is found within it; the edge found is then the nearest.
#pragma once

#include <vector>

#include "structure/foam/seeds.h"

namespace msq {

/// By how much an onset may be off, in foam units. An edge's line is found within 4 units of 2^-53
/// times the radius of its circle over the triangle's shortest side; 1e-9 is room for seeds down to
/// 1e-5 of a cell from each other, and for the tolerances of EdgeLine.
constexpr double onset_slack = 1e-9;

/// Most points of a foam with a seed for each unit of volume are within this of an edge.
constexpr double first_onset_radius = 0.25;

/// Onset of q (foam units, from the corner of `cell`), in foam units.
double foam_onset(const FoamSeeds& seeds, CellIndex cell, Vec3 q);

/// Distance from q to the nearest edge of some seeds if it is at most `radius`, otherwise infinity.
/// The seeds are at least those that matter within the radius, in the order of seeds; lengths are
/// in units that EdgeLine's tolerances suit.
double edge_within(const std::vector<Vec3>& seeds, Vec3 q, double radius);

/// The same for the least of the radii first, 2 first, 4 first ... that is enough; at least `most`
/// where none up to that is. gather(radius) returns the seeds for that radius.
template <class Gather>
double nearest_edge(Vec3 q, double first, double most, Gather&& gather) {
  for (double radius = first;; radius *= 2) {
    const double found = edge_within(gather(radius), q, radius);
    if (found <= radius) return found;
    if (radius >= most) return radius;
  }
}

}  // namespace msq
