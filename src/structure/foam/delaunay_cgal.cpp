// SPDX-License-Identifier: Apache-2.0
// Delaunay triangulation by CGAL, in place of the paper's own Bowyer-Watson: exact predicates, and
// adjacency for free, so no search for the pairs of tetrahedra that share a face. The paper
// rescales the seeds to the unit cube against rounding; exact predicates need no such care. Source:
// paper, section "Preprocessing for Voronoi Foams".
//
// CGAL's triangulations are under the GPL: a build with this file is too.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <utility>

#include "structure/foam/delaunay.h"

namespace msq {

namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase>>;
}  // namespace

bool can_triangulate() {
  return true;
}

std::vector<DelaunayFacet> delaunay_facets(const std::vector<Vec3>& seeds) {
  std::vector<std::pair<Kernel::Point_3, uint32_t>> points;
  points.reserve(seeds.size());
  for (uint32_t i = 0; i < seeds.size(); ++i)
    points.emplace_back(Kernel::Point_3(seeds[i].x, seeds[i].y, seeds[i].z), i);
  const Triangulation triangulation(points.begin(), points.end());

  std::vector<DelaunayFacet> facets;
  facets.reserve(triangulation.number_of_finite_facets());
  for (const auto& [cell, corner] : triangulation.finite_facets()) {
    DelaunayFacet facet;
    for (int i = 0, n = 0; i < 4; ++i)
      if (i != corner) facet.seeds[n++] = cell->vertex(i)->info();
    std::sort(facet.seeds.begin(), facet.seeds.end());
    const auto far_side = triangulation.mirror_vertex(cell, corner);
    const auto opposite = [&](const auto& vertex) {
      return triangulation.is_infinite(vertex) ? int64_t{-1} : int64_t{vertex->info()};
    };
    facet.opposite = {opposite(cell->vertex(corner)), opposite(far_side)};
    facets.push_back(facet);
  }
  return facets;
}

}  // namespace msq
