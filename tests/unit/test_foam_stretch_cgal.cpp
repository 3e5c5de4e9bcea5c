// SPDX-License-Identifier: Apache-2.0
// Stretched foams against a global Delaunay triangulation (CGAL) of seeds whose coordinates are
// divided by the stretch: edges and faces are its dual, multiplied by the stretch again. Distances
// from edges and from the polygons of faces are taken in model space.
#include "foam_diagram.h"
#include "foam_diagram_check.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  Vec3 stretch, cell_size;
  double jitter;
  uint64_t seed;
  bool is_turned;
};
const Row rows[] = {
    {{1, 1, 3}, {1, 1, 1}, 1, 21, false},        {{2, 0.5, 1}, {1, 1, 1}, 1, 22, true},
    {{1, 3, 1}, {1, 0.5, 0.75}, 0.5, 23, false}, {{1, 1, 16}, {1, 1, 1}, 1, 24, false},
    {{0.0625, 1, 1}, {1, 1, 1}, 1, 25, false},   {{5, 1, 0.4}, {2.5, 2.5, 2.5}, 1, 26, true},
    {{0.5, 1, 1}, {0.25, 1, 1}, 1, 27, false},
};

Vec3 over(Vec3 a, Vec3 b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}

/// Half the cells of the box that is asked, along each axis.
constexpr double asked_half = 1;

Diagram diagram_of(const Row& row) {
  // The sphere about a vertex reaches at most the diagonal of a cell, in the space of the diagram.
  const Vec3 sides = over(row.cell_size, row.stretch);
  const FoamSeeds seeds(row.seed, row.jitter, {1, 1, 1});
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(asked_half + 2 + 2.5 * length(sides) / sides[axis]));
  std::vector<Vec3> points;
  for (int z = -half[2]; z < half[2]; ++z)
    for (int y = -half[1]; y < half[1]; ++y)
      for (int x = -half[0]; x < half[0]; ++x)
        points.push_back(over(seeds.at({}, x, y, z) * row.cell_size, row.stretch));
  // Of what comes within two cells of the box that is asked.
  const Vec3 most = row.cell_size * (asked_half + 2);
  Diagram diagram;
  for (const DualEdge& e : dual_edges(points)) {
    const Segment edge(e.a * row.stretch, e.b * row.stretch);
    if (reaches_box(edge, most)) diagram.edges.push_back(edge);
  }
  for (std::vector<Vec3>& face : dual_faces(points)) {
    for (Vec3& corner : face) corner = corner * row.stretch;
    if (reaches_box(face, most)) diagram.faces.push_back(face);
  }
  return diagram;
}

void test_diagram(void**) {
  for (const Row& row : rows) {
    char name[64];
    snprintf(name, sizeof name, "stretch %g %g %g", row.stretch.x, row.stretch.y, row.stretch.z);
    const Neighbourhood grid = diagram_grid(row.cell_size, row.is_turned);
    check_foam_diagram({name, grid, row.jitter, row.seed, row.stretch}, diagram_of(row), asked_half,
                       {0.05, 0.2}, 0.1);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
