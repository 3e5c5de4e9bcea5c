// SPDX-License-Identifier: Apache-2.0
// The point query of foams: the definition that every other method agrees with.
#pragma once

#include "structure/foam/seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool foam_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius);

}  // namespace msq
