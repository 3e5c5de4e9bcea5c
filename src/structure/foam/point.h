// SPDX-License-Identifier: Apache-2.0
// The point query of foams: the definition that every other method agrees with.
#pragma once

#include <vector>

#include "structure/foam/seeds.h"

namespace msq {

/// Room for the rounding of distances in the choice of seeds, foam units; a seed too many never
/// changes the answer.
constexpr double near_slack = 1e-9;

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);

/// The last step of that: the seeds that matter are given in the order of their cells, all within
/// nearest distance + 2 radius + near_slack of q.
bool foam_point_inside(const std::vector<Vec3>& near, Vec3 q, double radius);

}  // namespace msq
