// SPDX-License-Identifier: Apache-2.0
// The point query of weighted foams (seeds.h), which is their definition.
//
// Which seeds matter to the edges within R of a point q: as in onset.h, with lifted distances. The
// lifted distance from a seed changes by at most R within R of q. With d0 the least at q, a seed
// that is farther than d0 + 2 R there is farther than the nearest one in the whole ball. Of the
// others, a seed matters only if the plane of equal power between it and the nearest one is within
// R of q.
//
// Errors. Seeds of an edge are at most 4 apart, and the foot of the perpendicular from a seed to
// the line is within empty_radius() of the seed, as the edge is. So the rounding of the line is at
// most 2^-44 / |direction|, twice the area of the triangle being |direction|. Three seeds that are
// nearly on a line may have an edge, other than in a Voronoi diagram: onset_slack (onset.h) covers
// |direction| down to 2^-14. Fewer than one in 1e10 edges is of flatter triangles if the jitter is
// 1: the chance that three seeds are so near to a line goes with the square of that number, and the
// chance that their planes then meet near them with the number.
#pragma once

#include <vector>

#include "structure/foam/point/edges_near.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool weighted_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);
/// Distance from that point to the nearest edge.
double weighted_onset(const FoamSeeds& seeds, CellIndex cell, Vec3 q);
/// find_edges_near() of a weighted foam.
void find_weighted_edges_near(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius,
                              std::vector<NearEdge>& struts);

}  // namespace msq
