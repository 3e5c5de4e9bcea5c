// SPDX-License-Identifier: Apache-2.0
// Foams whose seeds a map places, against a global Delaunay triangulation (CGAL) of the mapped
// seeds. The places are found by bisection of the map itself, not by its inverse.
#include "foam_diagram.h"
#include "foam_diagram_check.h"
#include "structure/foam/seeds/period_seeds.h"

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
  Diagram diagram;
  for (const DualEdge& e : dual_edges(points)) {
    const Segment edge(e.a, e.b);
    if (reaches_box(edge, most)) diagram.edges.push_back(edge);
  }
  for (const std::vector<Vec3>& face : dual_faces(points))
    if (reaches_box(face, most)) diagram.faces.push_back(face);
  print_message("%s: %zu seeds\n", row.name, points.size());
  return diagram;
}

void test_diagram(void**) {
  for (const Row& row : rows) {
    const std::shared_ptr<const PlacedSeeds> placed = std::make_shared<const PeriodSeeds>(
        diagram_grid(row.cell_size, row.is_turned), GradedPeriod(row.axis, row.knots), row.jitter,
        row.seed);
    check_foam_diagram({row.name, placed->grid(), row.jitter, row.seed, {1, 1, 1}, 0, placed},
                       diagram_of(row), asked_half, {0.4, 0.95}, 0.2);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
