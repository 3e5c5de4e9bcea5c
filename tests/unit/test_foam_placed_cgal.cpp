// SPDX-License-Identifier: Apache-2.0
// Foams whose seeds a map places, against a global Delaunay triangulation (CGAL) of the mapped
// seeds. The places are found by bisection of the map itself, not by its inverse.
#include "diagram_check.h"
#include "foam_diagram.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/period_seeds.h"
#include "structure/foam/walls/foam_walls.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  Vec3 cell_size;
  int axis;
  std::vector<GradedPeriod::Knot> knots;
  double jitter;
  uint64_t seed;
  bool is_turned;
};
const Row rows[] = {
    {"half to double", {1, 1, 1}, 2, {{-1.5, 0.5}, {1.5, 2}}, 1, 31, false},
    {"step", {1, 0.75, 1.25}, 0, {{-0.2, 0.25}, {0.1, 1.5}}, 1, 32, true},
    {"limit", {2, 2, 1}, 1, {{-1, 2}, {0, 0.125}, {1, 2}}, 1, 33, false},
    {"waves, jitter 0.5",
     {0.5, 0.5, 1},
     2,
     {{-1, 0.5}, {0, 1.5}, {0.5, 0.25}, {2, 1}},
     0.5,
     34,
     true},
    {"thin", {1, 1, 1}, 2, {{0, 0.25}}, 1, 35, false},
    {"jitter 0", {1, 1, 1}, 0, {{-1, 0.5}, {1, 1.25}}, 0, 36, false},
};

Neighbourhood grid_of(const Row& row) {
  if (!row.is_turned) return {{}, row.cell_size, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, row.cell_size, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

/// The coordinate with so many cells.
double place_of(const GradedPeriod& period, double cells) {
  double low = -1e3, high = 1e3;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (period.cells(middle) < cells ? low : high) = middle;
  }
  return low;
}

/// Half the box that is asked, in its largest cells.
constexpr double asked_half = 1;

Diagram diagram_of(const Row& row) {
  const GradedPeriod period(row.axis, row.knots);
  Vec3 largest = row.cell_size;
  largest[row.axis] = period.largest();
  const FoamSeeds seeds(row.seed, row.jitter, {1, 1, 1});
  // Of what comes within two cells of the box that is asked. The sphere about a vertex reaches at
  // most the diagonal of a cell.
  const Vec3 most = largest * (asked_half + 1.5);
  int first[3], end[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = most[axis] + 2.2 * length(largest);
    const auto cells = [&](double at) {
      return axis == row.axis ? period.cells(at) : at / row.cell_size[axis];
    };
    first[axis] = static_cast<int>(std::floor(cells(-reach)));
    end[axis] = static_cast<int>(std::ceil(cells(reach)));
  }
  std::vector<Vec3> points;
  for (int z = first[2]; z < end[2]; ++z)
    for (int y = first[1]; y < end[1]; ++y)
      for (int x = first[0]; x < end[0]; ++x) {
        const Vec3 cells = seeds.at({}, x, y, z);
        Vec3 place = cells * row.cell_size;
        place[row.axis] = place_of(period, cells[row.axis]);
        points.push_back(place);
      }
  const auto is_near = [&](const auto& part) {
    return box_of(part).overlaps(Box3{most * -1.0, most});
  };
  Diagram diagram;
  for (const DualEdge& e : dual_edges(points)) {
    const Segment edge(e.a, e.b);
    if (is_near(edge)) diagram.edges.push_back(edge);
  }
  for (const std::vector<Vec3>& face : dual_faces(points))
    if (is_near(face)) diagram.faces.push_back(face);
  print_message("%s: %zu seeds\n", row.name, points.size());
  return diagram;
}

void test_diagram(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  size_t points = 0;
  for (const Row& row : rows) {
    const Diagram diagram = diagram_of(row);
    const std::shared_ptr<const PlacedSeeds> placed = std::make_shared<const PeriodSeeds>(
        grid_of(row), GradedPeriod(row.axis, row.knots), row.jitter, row.seed);
    const Neighbourhood grid = placed->grid();
    const double size = min_component(placed->smallest().cell_size);
    const size_t count = test_count(5500);
    const Vec3 half = grid.cell_size * asked_half;
    const double near = 3e-8 * max_component(grid.cell_size);
    for (const double part : {0.4, 0.95}) {
      const double radius = part * size;
      const Ref<const Structure> foam =
          make_ref<Foam>(context, grid, Parameter(radius), row.jitter, row.seed, FoamMethod::direct,
                         Parameter(1), Vec3{1, 1, 1}, 0.0, placed);
      check_diagram(row.name, "edges", *foam,
                    ask(diagram.edges, grid, half, radius, count, row.seed), radius, 1, near);
    }
    const double thickness = 0.2 * size;
    const Ref<const Structure> walls =
        make_ref<FoamWalls>(context, grid, Parameter(thickness), row.jitter, row.seed, Parameter(1),
                            Parameter(0), Vec3{1, 1, 1}, 0.0, placed);
    check_diagram(row.name, "faces", *walls,
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
