// SPDX-License-Identifier: Apache-2.0
// The point query of graded foams: the definition that every other way agrees with. And their
// onset.
#pragma once

#include <memory>

#include "structure/foam/graded_seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool graded_point_inside(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                         double radius);

/// Distance from q to the nearest edge, in foam units: onset.h.
double graded_onset(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q);

}  // namespace msq
