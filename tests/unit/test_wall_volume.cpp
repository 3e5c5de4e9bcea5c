// SPDX-License-Identifier: Apache-2.0
// Lines, times the width of thin walls across them in the plane, over a stack of planes, against
// the part of random points of these planes that is solid.
#include <algorithm>
#include <cmath>
#include <vector>

#include "expression/parser.h"
#include "images.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/walls/foam_walls.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/plates/plate_lattice.h"
#include "structure/waves/waves.h"

using namespace msq;
using namespace msq::test;

namespace {

const Neighbourhood cubes{}, uneven{{0.1, -0.3, 0.2}, {1, 0.8, 0.9}, {}},
    turned{{0.3, 0.2, -0.7}, {1, 0.8, 0.9}, skew_rotation()};
const Box2 box{{0, 0}, {6, 5}};
/// Where walls meet, they count twice: of plates, more often.
constexpr double thickness = 0.005, plate_thickness = 0.002;

Ref<const Structure> walls(const Neighbourhood& grid, Vec3 stretch = {1, 1, 1}, double weight = 0,
                           double vent_radius = 0) {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return make_ref<FoamWalls>(context, grid, Parameter(thickness), 1.0, uint64_t{3}, Parameter(1),
                             Parameter(vent_radius), stretch, weight);
}

Ref<const Structure> gyroid(const Neighbourhood& grid, CellShape cells = {}) {
  return make_ref<Functional>(grid, parse_expression(preset_expressions[0], {}),
                              FunctionalKind::sheet, Parameter(0.05), 1, std::move(cells));
}

Ref<const Structure> around(Warp::Kind kind) {
  const Neighbourhood grid{{3, 2.5, 1}, {0.8, 0.8, 0.8}, {}};
  return gyroid(grid, Warp(kind, grid, {14, kind == Warp::Kind::spherical ? 8u : 0u, 1.1, 2.3}));
}

Ref<const Structure> waves() {
  WaveDirections directions;
  directions.seed = 5;
  directions.count = 60;
  directions.half_angles = {1.5, 1.5, 1.5};
  return make_ref<Waves>(cubes, directions, WavesKind::sheet, Parameter(0.03));
}

/// The onset grows from 0 on both sides of a line, and is the parameter at the borders of the wall.
/// That of planes grows in proportion to the distance.
double width_at(const Structure& structure, Vec3 p, Vec2 normal, bool is_plane) {
  const double parameter = structure.parameter(p);
  double sum = 0;
  for (const double side : {-1.0, 1.0}) {
    double width = 1e-4;
    for (int i = 0; i < (is_plane ? 1 : 6); ++i) {
      const Vec3 q = p + Vec3{normal.x, normal.y, 0} * (side * width);
      width = std::min(0.1, width * parameter / structure.onset(q));
    }
    sum += width;
  }
  return sum;
}

void check(const char* name, const Structure& structure, bool is_plane) {
  Random random(2);
  const int heights = 24;
  double sum = 0;
  size_t inside = 0, count = 0;
  const size_t points = test_count(400000) / heights;
  for (int i = 0; i < heights; ++i) {
    const double z = (i + random.unit()) * 4 / heights;
    const LineGraph graph = structure.wall_lines({z, box, 1e-4});
    for (const auto& [a, b] : graph.lines) {
      const Vec2 from = graph.points[a], way = graph.points[b] - from;
      const double span = length(way);
      const int parts = span > 0.1 ? 8 : 1;
      for (int part = 0; part < parts; ++part) {
        const Vec2 p = from + way * ((part + random.unit()) / parts);
        if (!box.contains(p)) continue;
        const Vec2 normal{-way.y / span, way.x / span};
        sum += span / parts * width_at(structure, {p.x, p.y, z}, normal, is_plane);
      }
    }
    for (size_t k = 0; k < points; ++k) {
      const Vec2 p{random.between(box.min.x, box.max.x), random.between(box.min.y, box.max.y)};
      inside += structure.inside({p.x, p.y, z});
      ++count;
    }
  }
  const double area = heights * box.extent().x * box.extent().y;
  const double found = sum / area, known = static_cast<double>(inside) / static_cast<double>(count);
  const double error = 3 / std::sqrt(static_cast<double>(inside));
  print_message("%s: %.5f by lines, %.5f of the points, %+.2f %%\n", name, found, known,
                100 * (found / known - 1));
  assert_true(std::abs(found / known - 1) < 0.02 + error);
}

void test_lines_times_width_are_the_solid(void**) {
  check("foam", *walls(uneven), true);
  check("stretched foam", *walls(turned, {1, 0.6, 1.5}), true);
  check("weighted foam", *walls(turned, {1, 1, 1}, 0.7), true);
  check("foam with holes", *walls(cubes, {1, 1, 1}, 0, 0.25), true);
  check("plates",
        *make_ref<PlateLattice>(turned, cubic_octet_plate_cell(), Parameter(plate_thickness)),
        true);
  check("Kelvin plates",
        *make_ref<PlateLattice>(turned, kelvin_plate_cell(), Parameter(plate_thickness)), true);
  check("gyroid", *gyroid(uneven), false);
  check("gyroid around an axis", *around(Warp::Kind::cylindrical), false);
  check("gyroid around a point", *around(Warp::Kind::spherical), false);
  check("waves", *waves(), false);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_lines_times_width_are_the_solid)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
