// SPDX-License-Identifier: Apache-2.0
// Weighted foams against a global regular triangulation (CGAL) of the seeds and the squares of
// their radii: edges and faces are its dual.
#include "foam_diagram_check.h"
#include "power_diagram.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  double weight;
  Vec3 cell_size;
  double jitter;
  uint64_t seed;
  bool is_turned;
};
const Row rows[] = {
    {1, {1, 1, 1}, 1, 31, false},       {0.5, {1, 1, 1}, 1, 32, true},
    {0.1, {1, 1, 1}, 1, 33, false},     {0.25, {1, 0.25, 0.5}, 1, 34, false},
    {2, {2.5, 2, 2.5}, 0.5, 35, true},  {1, {1, 1, 1}, 0, 36, false},
    {0.7, {1, 1, 0.75}, 0.1, 37, true},
};

/// Half the cells of the box that is asked, along each axis.
constexpr double asked_half = 1.5;

/// The diagram about the origin of the grid, in model units along its axes.
Diagram diagram_of(const Row& row) {
  const FoamSeeds seeds(row.seed, row.jitter, {1, 1, 1});
  // A cell lies within this of its seed.
  const double reach = std::sqrt(dot(row.cell_size, row.cell_size) + row.weight * row.weight);
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(asked_half + 1 + 2.5 * reach / row.cell_size[axis]));
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (int z = -half[2]; z < half[2]; ++z)
    for (int y = -half[1]; y < half[1]; ++y)
      for (int x = -half[0]; x < half[0]; ++x) {
        points.push_back(seeds.at({}, x, y, z) * row.cell_size);
        // As docs/seeds.md defines it.
        const uint64_t bits = splitmix_finalise(seeds.bits({x, y, z}) ^ 0x776569676874);
        const double radius = row.weight * (static_cast<double>(bits >> 43) / (1 << 21));
        weights.push_back(radius * radius);
      }
  size_t hidden;
  Diagram all = power_diagram(points, weights, hidden), diagram;
  print_message("weight %g: %zu of %zu seeds have no cell\n", row.weight, hidden, points.size());
  const Vec3 most = row.cell_size * (asked_half + 1);
  for (const Segment& edge : all.edges)
    if (reaches_box(edge, most)) diagram.edges.push_back(edge);
  for (const std::vector<Vec3>& face : all.faces)
    if (reaches_box(face, most)) diagram.faces.push_back(face);
  return diagram;
}

void test_diagram(void**) {
  for (const Row& row : rows) {
    char name[64];
    snprintf(name, sizeof name, "weight %g", row.weight);
    const Neighbourhood grid = diagram_grid(row.cell_size, row.is_turned);
    check_foam_diagram({name, grid, row.jitter, row.seed, {1, 1, 1}, row.weight}, diagram_of(row),
                       asked_half, {0.05, 0.2}, 0.1);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
