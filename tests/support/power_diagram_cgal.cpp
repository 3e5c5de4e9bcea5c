// SPDX-License-Identifier: Apache-2.0
#include "power_diagram.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace msq::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Regular = CGAL::Regular_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase,
                                                 CGAL::Regular_triangulation_cell_base_3<Kernel>>>;

/// The point of equal power, in extended precision.
Vec3 centre_of(const std::vector<Vec3>& seeds, const std::vector<double>& weights,
               Regular::Cell_handle tetrahedron) {
  using Real = long double;
  const uint32_t first = tetrahedron->vertex(0)->info();
  Real m[3][3], h[3];
  for (int i = 0; i < 3; ++i) {
    const uint32_t other = tetrahedron->vertex(i + 1)->info();
    h[i] = (Real(weights[first]) - Real(weights[other])) / 2;
    for (int axis = 0; axis < 3; ++axis) {
      m[i][axis] = Real(seeds[other][axis]) - Real(seeds[first][axis]);
      h[i] += m[i][axis] * m[i][axis] / 2;
    }
  }
  const auto determinant = [&](int column) {
    Real n[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) n[i][j] = j == column ? h[i] : m[i][j];
    return n[0][0] * (n[1][1] * n[2][2] - n[1][2] * n[2][1]) -
           n[0][1] * (n[1][0] * n[2][2] - n[1][2] * n[2][0]) +
           n[0][2] * (n[1][0] * n[2][1] - n[1][1] * n[2][0]);
  };
  const Real all = determinant(3);
  return seeds[first] + Vec3{static_cast<double>(determinant(0) / all),
                             static_cast<double>(determinant(1) / all),
                             static_cast<double>(determinant(2) / all)};
}

}  // namespace

Diagram power_diagram(const std::vector<Vec3>& seeds, const std::vector<double>& weights,
                      size_t& hidden) {
  std::vector<std::pair<Kernel::Weighted_point_3, uint32_t>> points;
  for (uint32_t i = 0; i < seeds.size(); ++i)
    points.emplace_back(
        Kernel::Weighted_point_3(Kernel::Point_3(seeds[i].x, seeds[i].y, seeds[i].z), weights[i]),
        i);
  const Regular regular(points.begin(), points.end());
  hidden = seeds.size() - regular.number_of_vertices();
  Diagram diagram;
  for (const auto& [cell, corner] : regular.finite_facets()) {
    const auto other = cell->neighbor(corner);
    if (!regular.is_infinite(cell) && !regular.is_infinite(other))
      diagram.edges.push_back(
          Segment(centre_of(seeds, weights, cell), centre_of(seeds, weights, other)));
  }
  for (const auto& edge : regular.finite_edges()) {
    std::vector<Vec3> corners;
    bool is_bounded = true;
    const auto first = regular.incident_cells(edge);
    auto at = first;
    do {
      is_bounded = is_bounded && !regular.is_infinite(at);
      if (is_bounded) corners.push_back(centre_of(seeds, weights, at));
    } while (++at != first);
    if (is_bounded) diagram.faces.push_back(std::move(corners));
  }
  return diagram;
}

}  // namespace msq::test
