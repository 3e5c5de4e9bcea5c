// SPDX-License-Identifier: Apache-2.0
// Foams in cells around an axis or a point, against a global Delaunay triangulation (CGAL) of the
// seeds of all rings: from the axis to farther out than the foam has any. The C library places
// them.
#include <cmath>

#include "base/pi.h"
#include "shelled_check.h"
#include "structure/common/warp_shell.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/shell/shelled_foam.h"
#include "structure/foam/walls/foam_walls.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  uint32_t count;
  double inner, outer, thick, high;  // of the shell; sizes of cells
  double jitter;
  uint64_t seed;
  bool is_turned;
  uint32_t polar = 0;              // cells from pole to pole
  double outwards = 0, along = 0;  // shears
};
const Row rows[] = {
    {"even", 24, 4, 7, 1, 1, 1, 41, false},
    {"to near the axis", 12, 1.25, 4, 1, 1, 1, 42, true},
    {"flat and wide", 10, 2.5, 6, 0.5, 0.75, 1, 43, true},
    {"narrow", 96, 4, 5, 1, 0.5, 0.5, 44, false},
    {"high", 24, 3, 4.5, 0.75, 3, 1, 45, false},
    {"thin shell", 30, 5, 5.4, 1, 1, 1, 46, true},
    {"few around", 4, 0.75, 1.5, 1, 1, 1, 47, false},
    {"jitter 0", 16, 2, 4, 1, 1, 0, 48, false},
    {"sheared along", 20, 3, 5, 1, 1, 1, 49, true, 0, 0, 1.5},
    {"sheared outwards", 24, 4, 6, 1, 0.75, 1, 50, false, 0, -1, 0},
    {"sheared to near the axis", 9, 1, 3, 1, 1, 1, 51, true, 0, 0.75, -0.5},
    {"sphere", 24, 4, 5.5, 1, 1, 1, 52, true, 12},
    {"sphere to near the point", 12, 1.25, 3, 1, 1, 1, 53, false, 6},
    {"sphere of flat cells", 16, 3, 4, 0.5, 1, 0.7, 54, true, 10},
    {"sphere with few cells", 5, 0.75, 1.5, 1, 1, 1, 55, false, 2},
};

Neighbourhood grid_of(const Row& row) {
  const Vec3 size{row.thick, 123, row.high};  // that along y is not used
  if (!row.is_turned) return {{}, size, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, size, {{c, 0, s, 0, 1, 0, -s, 0, c}}};
}

Warp warp_of(const Row& row, const Neighbourhood& grid) {
  return {row.polar > 0 ? Warp::Kind::spherical : Warp::Kind::cylindrical,
          grid,
          {row.count, row.polar, row.inner, row.outer, row.outwards, row.along}};
}

Vec3 half_of(const Row& row) {
  return {1.1 * row.outer, 1.1 * row.outer, row.polar > 0 ? 1.1 * row.outer : 1.2 * row.high};
}

/// Farther from the shell than any seed that decides.
double margin_of(const Row& row) {
  const auto diagonal = [&](double r) {
    const double swell = 1 + std::abs(row.outwards) + std::abs(row.along);
    return length(Vec3{row.thick, swell * two_pi * (r + row.thick) / row.count,
                       row.polar > 0 ? pi * (r + row.thick) / row.polar : row.high});
  };
  return 1 + 2.2 * diagonal(row.outer + 1 + diagonal(row.outer + 1));
}

Diagram diagram_of(const Row& row) {
  const FoamSeeds seeds(row.seed, row.jitter, {1, 1, 1});
  const Vec3 half = half_of(row), most = half + Vec3{1, 1, 1};
  const double margin = margin_of(row), turn = two_pi / row.count;
  const auto whole = [](double cells) { return static_cast<int>(std::floor(cells)); };
  const int first = whole(-row.inner / row.thick),
            last = whole((row.outer + margin - row.inner) / row.thick),
            high = row.polar > 0 ? 0 : whole((most.z + margin) / row.high) + 1,
            top = row.polar > 0 ? static_cast<int>(row.polar) : high;
  std::vector<Vec3> points;
  for (int k = -high; k < top; ++k)
    for (int j = 0; j < static_cast<int>(row.count); ++j)
      for (int i = first; i <= last; ++i) {
        const Vec3 cells = seeds.at({}, i, j, k);
        const double r = row.inner + cells.x * row.thick,
                     angle = turn * (cells.y - row.outwards * cells.x - row.along * cells.z),
                     latitude = row.polar > 0 ? pi * (cells.z / row.polar - 0.5) : 0,
                     across = r * std::cos(latitude);
        points.push_back({across * std::cos(angle), across * std::sin(angle),
                          row.polar > 0 ? r * std::sin(latitude) : cells.z * row.high});
      }
  const Diagram diagram = diagram_among(points, most);
  print_message("%s: %zu seeds\n", row.name, points.size());
  return diagram;
}

/// The distance from the shell of a point, in grid coordinates; in it below 0.
double beyond(const Row& row, Vec3 g) {
  const double r = row.polar > 0 ? length(g) : std::hypot(g.x, g.y);
  return std::max(row.inner - r, r - row.outer);
}

void test_diagram(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  for (const Row& row : rows) {
    const Diagram diagram = diagram_of(row);
    const Neighbourhood frame = grid_of(row);
    const Warp warp = warp_of(row, frame);
    const std::shared_ptr<const PlacedSeeds> placed =
        std::make_shared<const WarpSeeds>(context, warp, row.jitter, row.seed);
    const auto shell = std::make_shared<const WarpShell>(warp);
    const Neighbourhood grid = placed->grid();
    const double size = min_component(placed->smallest().cell_size);
    const size_t count = test_count(3000);
    const Vec3 half = half_of(row);
    const double near = 3e-8 * max_component(grid.cell_size);
    const auto from_shell = [&](Vec3 p) { return beyond(row, frame.to_grid(p)); };
    print_message("  boxes of %g x %g\n", grid.cell_size.x, grid.cell_size.z);
    for (const double part : {0.15, 0.45}) {
      const double radius = part * size;
      const Ref<const Structure> foam =
          make_ref<Foam>(context, grid, Parameter(radius), row.jitter, row.seed, FoamMethod::direct,
                         Parameter(1), Vec3{1, 1, 1}, 0.0, placed);
      check_shelled(row.name, "edges", *make_ref<ShelledFoam>(foam, shell),
                    ask(diagram.edges, frame, half, radius, count, row.seed), from_shell, radius, 1,
                    near);
    }
    // Without jitter, four seeds of one face of cells are on a circle up to rounding: the oracle
    // has flat tetrahedra, whose centres are no corners of faces.
    if (row.jitter == 0) continue;
    const double thickness = 0.2 * size;
    const Ref<const Structure> walls =
        make_ref<FoamWalls>(context, grid, Parameter(thickness), row.jitter, row.seed, Parameter(1),
                            Parameter(0), Vec3{1, 1, 1}, 0.0, placed);
    check_shelled(row.name, "faces", *make_ref<ShelledFoam>(walls, shell),
                  ask(diagram.faces, frame, half, 0.5 * thickness, count, row.seed), from_shell,
                  0.5 * thickness, 2, near);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
