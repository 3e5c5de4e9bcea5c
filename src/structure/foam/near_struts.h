// SPDX-License-Identifier: Apache-2.0
// The struts about a point, exactly: what is asked of single points of rays.
#pragma once

#include <array>
#include <vector>

#include "structure/foam/edge_line.h"
#include "structure/foam/seeds.h"

namespace msq {

struct NearStrut {
  EdgeLine line;                   ///< from the corner of the point's cell
  LineInterval part;               ///< of it that is an edge and within the radius of the point
  std::array<CellIndex, 3> seeds;  ///< in the order of seeds
  double distance_squared;         ///< of the point from the part
};

/// Fills `struts` with the edges that come within `radius` of a point, q from the corner of `cell`
/// in foam units.
void find_near_struts(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius,
                      std::vector<NearStrut>& struts);

}  // namespace msq
