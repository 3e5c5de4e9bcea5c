// SPDX-License-Identifier: Apache-2.0
// Delaunay triangulation of a few hundred seeds, as its facets, which are the duals of Voronoi
// edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

struct DelaunayFacet {
  std::array<uint32_t, 3> seeds;    ///< indices, ascending
  std::array<int64_t, 2> opposite;  ///< fourth seed of the tetrahedron on either side; -1: none
};

bool can_triangulate();

/// Uses exact predicates. The triangulation of seeds on one sphere is arbitrary. Throws
/// Error(unsupported) in builds without CGAL.
std::vector<DelaunayFacet> delaunay_facets(const std::vector<Vec3>& seeds);

}  // namespace msq
