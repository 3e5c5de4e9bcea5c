// SPDX-License-Identifier: Apache-2.0
// Stretched foams against a global Delaunay triangulation (CGAL) of seeds whose coordinates are
// divided by the stretch: edges and faces are its dual, multiplied by the stretch again. Distances
// from edges and from the polygons of faces are taken in model space.
#include "diagram_check.h"
#include "foam_diagram.h"
#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"

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

Neighbourhood grid_of(const Row& row) {
  if (!row.is_turned) return {{}, row.cell_size, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, row.cell_size, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

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
  const auto is_near = [&](const auto& part) {
    return box_of(part).overlaps(Box3{most * -1.0, most});
  };
  Diagram diagram;
  for (const DualEdge& e : dual_edges(points)) {
    const Segment edge(e.a * row.stretch, e.b * row.stretch);
    if (is_near(edge)) diagram.edges.push_back(edge);
  }
  for (std::vector<Vec3>& face : dual_faces(points)) {
    for (Vec3& corner : face) corner = corner * row.stretch;
    if (is_near(face)) diagram.faces.push_back(face);
  }
  return diagram;
}

void test_diagram(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  size_t points = 0;
  for (const Row& row : rows) {
    const Diagram diagram = diagram_of(row);
    const Neighbourhood grid = grid_of(row);
    const double size = min_component(row.cell_size);
    const size_t count = test_count(5500);
    const Vec3 half = row.cell_size * asked_half;
    const double near = 3e-8 * max_component(row.cell_size);
    char name[64];
    snprintf(name, sizeof name, "stretch %g %g %g", row.stretch.x, row.stretch.y, row.stretch.z);
    for (const double part : {0.05, 0.2}) {
      const double radius = part * size;
      const Ref<const Structure> foam =
          make_ref<Foam>(context, grid, Parameter(radius), row.jitter, row.seed, FoamMethod::direct,
                         Parameter(1), row.stretch);
      check_diagram(name, "edges", *foam, ask(diagram.edges, grid, half, radius, count, row.seed),
                    radius, 1, near);
    }
    const double thickness = 0.1 * size;
    const Ref<const Structure> walls =
        make_ref<FoamWalls>(context, grid, Parameter(thickness), row.jitter, row.seed, Parameter(1),
                            Parameter(0), row.stretch);
    check_diagram(name, "faces", *walls,
                  ask(diagram.faces, grid, half, 0.5 * thickness, count, row.seed), 0.5 * thickness,
                  2, near);
    points += 3 * count;
  }
  print_message("%zu points\n", points);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
