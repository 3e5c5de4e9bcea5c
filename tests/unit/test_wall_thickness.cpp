// SPDX-License-Identifier: Apache-2.0
// Calibration of sheets: areas of known surfaces, volume fractions, levels of walls whose thickness
// is known, and levels that grow with the thickness to the last bit.
//
// Areas in a cubic cell of side 1: the minimal surfaces' own (Schwarz P 2.3451, gyroid 3.0915, D
// 3.8378: Schoen 1970; Hyde et al., "The Language of Shape", 1997), which the functions' surfaces
// come within 1 % of. Volume fractions: test_functional.cpp.
#include "structure/functional/wall_thickness.h"

#include <cmath>

#include "expression/parser.h"
#include "random.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

WallThickness walls_of(const char* text, Vec3 cell_size = {1, 1, 1}) {
  return WallThickness(parse_expression(text, {}), cell_size);
}

void is_near(const char* what, double got, double wanted, double part) {
  if (!(std::abs(got - wanted) <= part * std::abs(wanted)))
    fail_msg("%s: %.9g, expected %.9g", what, got, wanted);
}

void areas(void**) {
  is_near("gyroid", walls_of(preset_expressions[0]).area(), 3.0915, 0.01);
  is_near("Schwarz P", walls_of(preset_expressions[1]).area(), 2.3451, 0.01);
  is_near("D", walls_of(preset_expressions[2]).area(), 3.8378, 0.01);
  const Vec3 cell{2, 3, 0.5};
  is_near("planes along x", walls_of("sin(x)", cell).area(), 2 * 3 * 0.5, 1e-12);
  is_near("planes along z", walls_of("cos(z)", cell).area(), 2 * 2 * 3, 1e-12);
  is_near("cylinder", walls_of("sqrt((x-pi)^2+(y-pi)^2)-2").area(), 2, 1e-4);
  is_near("ball", walls_of("sqrt((x-pi)^2+(y-pi)^2+(z-pi)^2)-3").area(), 9 / (two_pi / 2), 1e-4);
  is_near("ball stretched in all directions",
          walls_of("sqrt((x-pi)^2+(y-pi)^2+(z-pi)^2)-3", {3, 3, 3}).area(), 81 / (two_pi / 2),
          1e-4);
}

void volume_fractions(void**) {
  constexpr double levels[] = {0.1, 0.3, 0.5, 0.75, 1.0, 1.2, 1.4};
  struct Column {
    const char* function;
    double networks[7];
  };
  constexpr Column columns[] = {
      {preset_expressions[1], {.528536, .585639, .642835, .714561, .786670, .832035, .867578}},
      {preset_expressions[0], {.532186, .596724, .661782, .744468, .829725, .901046, .977556}},
      {preset_expressions[2], {.540936, .623019, .705759, .810923, .919410, .974776, .999612}},
  };
  for (const Column& column : columns) {
    const WallThickness walls = walls_of(column.function);
    for (size_t i = 0; i < 7; ++i) {
      const double wanted = 2 * column.networks[i] - 1;
      if (std::abs(walls.volume_fractions()(levels[i]) - wanted) > 1e-3)
        fail_msg("%s, level %g: %.6f, expected %.6f", column.function, levels[i],
                 walls.volume_fractions()(levels[i]), wanted);
    }
  }
}

/// |sin x| <= c: walls of 2 asin(c) / 2 pi of a cell, two to a cell.
void walls_of_known_thickness(void**) {
  for (double size : {1.0, 8.0}) {
    const WallThickness walls = walls_of("sin(x)", {size, 2, 3});
    is_near("the greatest", walls.most(), size / 2, 1e-12);
    for (double part : {0.01, 0.05, 0.1, 0.2, 0.3, 0.4}) {
      char what[60];
      std::snprintf(what, sizeof what, "walls of %g cells of %g", part, size);
      is_near(what, walls.levels()(part * size), std::sin(part * two_pi / 2), 3e-3);
    }
  }
  // Flat walls of the same slope everywhere.
  const WallThickness walls = walls_of("abs(x-pi)-pi/2");
  for (double t : {1e-6, 0.001, 0.1, 0.3})
    is_near("ramps", walls.levels()(t), t * two_pi / 2, 1e-6 + 1e-3);
}

/// Volume over area, by independent samples of the structure of the level.
void volume_of_a_thickness(void**) {
  const Vec3 cell{2, 3, 2.5};
  Neighbourhood grid;
  grid.cell_size = cell;
  uint64_t seed = 0;
  for (const char* text : preset_expressions) {
    const WallThickness walls = walls_of(text, cell);
    for (double thickness : {0.02, 0.2, 0.4}) {
      const double wanted = thickness * walls.area() / (cell.x * cell.y * cell.z);
      if (wanted > 0.95) continue;
      const Ref<Functional> structure =
          make_ref<Functional>(grid, parse_expression(text, {}), FunctionalKind::sheet,
                               Parameter(walls.levels()(thickness)), 0);
      Random random(++seed);
      const size_t count = test_count(300000);
      std::vector<Vec3> points(count);
      for (Vec3& p : points) p = random.in_box({{0, 0, 0}, cell});
      std::vector<uint8_t> alive(count, 1);
      structure->keep_points(points.data(), alive.data(), count);
      size_t held = 0;
      for (uint8_t a : alive) held += a;
      const double got = double(held) / double(count);
      const double error = std::sqrt(wanted * (1 - wanted) / double(count));
      if (std::abs(got - wanted) > 4 * error + 0.003 * wanted)
        fail_msg("%.30s, thickness %g: %.6f, expected %.6f, standard error %.6f", text, thickness,
                 got, wanted, error);
    }
  }
}

void levels_grow(void**) {
  for (const char* text : {preset_expressions[0], preset_expressions[6], "min(sin(x), 0.3)"}) {
    const WallThickness walls = walls_of(text);
    Random random(3);
    assert_true(walls.levels()(0) == 0);
    for (size_t i = test_count(100000); i > 0; --i) {
      const double a = random.between(0, walls.most());
      const double b = i % 2 ? std::nextafter(a, 1e9) : random.between(0, walls.most());
      const double low = walls.levels()(std::min(a, b)), high = walls.levels()(std::max(a, b));
      assert_true(low >= 0 && low <= high);
      assert_true(high - low <= walls.levels().lipschitz() * std::abs(b - a) + 0x1p-48 * high);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(areas),
      cmocka_unit_test(volume_fractions),
      cmocka_unit_test(walls_of_known_thickness),
      cmocka_unit_test(volume_of_a_thickness),
      cmocka_unit_test(levels_grow),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
