// SPDX-License-Identifier: Apache-2.0
// The point query of graded foams: the definition that every other way agrees with. And their
// onset.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/foam/graded_line.h"
#include "structure/foam/graded_seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool graded_point_inside(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                         double radius);

/// Distance from q to the nearest edge, in foam units: onset.h.
double graded_onset(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q);

struct NearGradedStrut {
  std::array<GradedSeedName, 3> seeds;  ///< from the point's cell, in the order of seeds
  double distance_squared;              ///< of the point from the edge, foam units
};
/// Fills `struts` with the edges that come within `radius` of q.
void find_near_graded_struts(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell,
                             Vec3 q, double radius, std::vector<NearGradedStrut>& struts);

}  // namespace msq
