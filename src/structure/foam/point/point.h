// SPDX-License-Identifier: Apache-2.0
// The point query of foams, which is their definition. All other methods agree with it.
#pragma once

#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);

/// The last step of that query. The relevant seeds are given in the order of their cells, all
/// within nearest distance + 2 radius + near_slack of q.
bool foam_point_inside(const std::vector<Vec3>& near, Vec3 q, double radius);

}  // namespace msq
