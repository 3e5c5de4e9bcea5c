// SPDX-License-Identifier: Apache-2.0
// The finite set of seeds that decides about the points of one cell.
//
// Let p be a point of the cell and v a point within r of p, on an edge or not. The seed nearest to
// v is within the empty radius e of v (seeds.h), hence within e + r of p. If v is on an edge, its
// three seeds are among the nearest to v; if v is on the line of three seeds but not on their edge,
// the seed nearest to v shows it. So seeds farther than e + r from all points of the cell neither
// own nor clip an edge within r of it. A block of h cells on every side extends h cell sizes beyond
// the cell: h = (e + r) / cell size, rounded up. With cubic cells e = sqrt(3), and h is 2 up to r =
// 2 - sqrt(3) = 0.268, 3 up to 1.268. Source: paper, section "Fine-scale Structures" (Voronoi
// Foams); the bound is ours.
#pragma once

#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Fills `found` with the seeds of that block, in the order of their cells (z, then y, then x), in
/// foam units from the cell's corner.
void halo_seeds(const FoamSeeds& seeds, CellIndex cell, double radius, std::vector<Vec3>& found);

/// The seeds that are nearest to some point within `radius` of a cell of size `scale`, and few
/// others; in the same order. With these seeds alone, the points within `radius` of an edge, and
/// EdgeLine's results for it, are the same.
std::vector<Vec3> seeds_that_matter(const std::vector<Vec3>& halo, Vec3 scale, double radius);

/// Slack for the rounding of distances; additional seeds never change the result.
constexpr double halo_slack = 1e-9;

}  // namespace msq
