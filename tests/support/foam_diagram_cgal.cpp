// SPDX-License-Identifier: Apache-2.0
#include "foam_diagram.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace msq::test {

Vec3 circumcentre(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  using Real = long double;
  Real m[3][3], h[3];
  const Vec3 others[3] = {b - a, c - a, d - a};
  for (int i = 0; i < 3; ++i) {
    h[i] = 0;
    for (int axis = 0; axis < 3; ++axis) {
      m[i][axis] = others[i][axis];
      h[i] += m[i][axis] * m[i][axis] / 2;
    }
  }
  const auto minor = [&](int i, int j, int p, int q) {
    return m[i][p] * m[j][q] - m[i][q] * m[j][p];
  };
  const Real det =
      m[0][0] * minor(1, 2, 1, 2) - m[0][1] * minor(1, 2, 0, 2) + m[0][2] * minor(1, 2, 0, 1);
  const Real x = h[0] * minor(1, 2, 1, 2) - h[1] * minor(0, 2, 1, 2) + h[2] * minor(0, 1, 1, 2);
  const Real y = h[0] * minor(1, 2, 0, 2) - h[1] * minor(0, 2, 0, 2) + h[2] * minor(0, 1, 0, 2);
  const Real z = h[0] * minor(1, 2, 0, 1) - h[1] * minor(0, 2, 0, 1) + h[2] * minor(0, 1, 0, 1);
  return a + Vec3{static_cast<double>(x / det), static_cast<double>(-y / det),
                  static_cast<double>(z / det)};
}

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase>>;

Delaunay triangulate(const std::vector<Vec3>& seeds) {
  std::vector<std::pair<Kernel::Point_3, uint32_t>> points;
  for (const Vec3& p : seeds)
    points.emplace_back(Kernel::Point_3(p.x, p.y, p.z), static_cast<uint32_t>(points.size()));
  return Delaunay(points.begin(), points.end());
}

Vec3 centre_of(const std::vector<Vec3>& seeds, Delaunay::Cell_handle tetrahedron) {
  Vec3 p[4];
  for (int i = 0; i < 4; ++i) p[i] = seeds[tetrahedron->vertex(i)->info()];
  return circumcentre(p[0], p[1], p[2], p[3]);
}

}  // namespace

std::vector<DualEdge> dual_edges(const std::vector<Vec3>& seeds) {
  const Delaunay delaunay = triangulate(seeds);
  std::vector<DualEdge> edges;
  for (const auto& [cell, corner] : delaunay.finite_facets()) {
    const auto other = cell->neighbor(corner);
    if (delaunay.is_infinite(cell) || delaunay.is_infinite(other)) continue;
    uint32_t first = UINT32_MAX;
    for (int i = 0; i < 4; ++i)
      if (i != corner) first = std::min(first, cell->vertex(i)->info());
    edges.push_back({centre_of(seeds, cell), centre_of(seeds, other), first});
  }
  return edges;
}

std::vector<std::vector<Vec3>> dual_faces(const std::vector<Vec3>& seeds) {
  const Delaunay delaunay = triangulate(seeds);
  std::vector<std::vector<Vec3>> faces;
  for (const auto& edge : delaunay.finite_edges()) {
    std::vector<Vec3> corners;
    bool is_bounded = true;
    const auto first = delaunay.incident_cells(edge);
    auto at = first;
    do {
      is_bounded = is_bounded && !delaunay.is_infinite(at);
      if (is_bounded) corners.push_back(centre_of(seeds, at));
    } while (++at != first);
    if (is_bounded) faces.push_back(std::move(corners));
  }
  return faces;
}

std::vector<DiagramEdge> foam_diagram(const FoamSeeds& seeds, const std::array<int, 3>& half) {
  std::vector<CellIndex> cells;  // in order
  std::vector<Vec3> positions;
  for (int z = -half[2]; z < half[2]; ++z)
    for (int y = -half[1]; y < half[1]; ++y)
      for (int x = -half[0]; x < half[0]; ++x) {
        cells.push_back({x, y, z});
        positions.push_back(seeds.at({0, 0, 0}, x, y, z));
      }
  std::vector<DiagramEdge> edges;
  for (const DualEdge& e : dual_edges(positions)) edges.push_back({e.a, e.b, cells[e.first]});
  return edges;
}

}  // namespace msq::test
