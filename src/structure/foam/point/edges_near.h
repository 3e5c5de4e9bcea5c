// SPDX-License-Identifier: Apache-2.0
// The struts around a point, computed exactly: for single points of rays.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "structure/foam/point/edge_line.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

struct NearEdge {
  EdgeLine line;                   ///< from the corner of the point's cell
  LineInterval part;               ///< of the line: the part that is an edge and within the radius
                                   ///< of the point
  std::array<CellIndex, 3> seeds;  ///< in the order of seeds
  double distance_squared;         ///< of the point from the part
  /// The least EdgeLine::lead() of all other seeds, of the line's point nearest to the point; below
  /// 0 if that is not on the edge. Infinite in foams that are stretched or have weights.
  double lead = std::numeric_limits<double>::infinity();
};

/// Fills `struts` with the edges that come within `radius` of a point, q from the corner of `cell`
/// in foam units.
void find_edges_near(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius,
                     std::vector<NearEdge>& struts);

}  // namespace msq
