// SPDX-License-Identifier: Apache-2.0
// The Voronoi edges of a foam over a box of cells, from one global Delaunay triangulation by CGAL.
#pragma once

#include <array>
#include <vector>

#include "structure/foam/seeds/seeds.h"

namespace msq::test {

struct DiagramEdge {
  Vec3 a, b;        ///< foam units, from the corner of cell 0
  CellIndex owner;  ///< first cell of the edge's three seeds, by z, then y, then x
};

/// Centre of the sphere through four points, in extended precision and from differences, which are
/// exact for the seeds of foams with cubic cells.
Vec3 circumcentre(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

struct DualEdge {
  Vec3 a, b;
  uint32_t first;  ///< of its three seeds
};

/// All edges among seeds that have both ends.
std::vector<DualEdge> dual_edges(const std::vector<Vec3>& seeds);

/// The corners, in turn, of all faces among seeds that are bounded.
std::vector<std::vector<Vec3>> dual_faces(const std::vector<Vec3>& seeds);

/// All edges among the seeds of cells [-half, half) along each axis that have both ends. Those
/// within twice the empty radius of the border of the box are not the foam's.
std::vector<DiagramEdge> foam_diagram(const FoamSeeds& seeds, const std::array<int, 3>& half);
inline std::vector<DiagramEdge> foam_diagram(const FoamSeeds& seeds, int half) {
  return foam_diagram(seeds, {half, half, half});
}

}  // namespace msq::test
