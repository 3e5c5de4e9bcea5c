// SPDX-License-Identifier: Apache-2.0
// The point query of graded foams, which is their definition, and their onset. All other paths
// agree with it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/foam/seeds/graded_seed_name.h"
#include "structure/foam/seeds/graded_seeds.h"

namespace msq {

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool graded_point_inside(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                         double radius);

/// Distance from q to the nearest edge, in foam units: onset.h.
double graded_onset(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q);

struct NearGradedEdge {
  std::array<GradedSeedName, 3> seeds;  ///< relative to the point's cell, in the order of seeds
  double distance_squared;              ///< of the point from the edge, foam units
  double lead;                          ///< as in NearEdge, in sizes of the nearest seed's leaf
  Vec3 ends[2];  ///< of the part within the radius, foam units, from the cell
};
/// Fills `struts` with the edges that come within `radius` of q.
void find_graded_edges_near(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                            double radius, std::vector<NearGradedEdge>& struts);

}  // namespace msq
