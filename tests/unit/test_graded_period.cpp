// SPDX-License-Identifier: Apache-2.0
// The map of a graded period against the integral of its frequency, and its bounds against samples;
// distances and rays through functional structures in such cells.
#include "cell/graded_period.h"

#include <cmath>

#include "cell/neighbourhood.h"
#include "expression/parser.h"
#include "random.h"
#include "ray_check.h"
#include "structure/functional/functional.h"
#include "structure/functional/graded_walls.h"
#include "structure/functional/presets.h"
#include "structure/functional/wall_thickness.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

using Knots = std::vector<GradedPeriod::Knot>;

Knots random_knots(Random& random) {
  Knots knots;
  double at = random.between(-6, 2);
  const size_t count = 1 + random.below(6);
  for (size_t i = 0; i < count; ++i) {
    knots.push_back({at, std::exp(random.between(-2, 2))});
    at += random.below(4) ? random.between(0.1, 5) : 1e-4;
  }
  return knots;
}

double frequency_at(const Knots& knots, double s) {
  if (s <= knots.front().position) return 1 / knots.front().cell_size;
  for (size_t i = 1; i < knots.size(); ++i) {
    const auto &a = knots[i - 1], &b = knots[i];
    if (s > b.position) continue;
    const double t = (s - a.position) / (b.position - a.position);
    return (1 - t) / a.cell_size + t / b.cell_size;
  }
  return 1 / knots.back().cell_size;
}

/// By the trapezoidal rule between the places where the frequency bends: exact for lines.
double integral(const Knots& knots, double from, double to) {
  if (from > to) return -integral(knots, to, from);
  std::vector<double> ends = {from};
  for (const auto& knot : knots)
    if (knot.position > from && knot.position < to) ends.push_back(knot.position);
  ends.push_back(to);
  double sum = 0;
  for (size_t i = 1; i < ends.size(); ++i)
    sum += 0.5 * (ends[i] - ends[i - 1]) *
           (frequency_at(knots, ends[i - 1]) + frequency_at(knots, ends[i]));
  return sum;
}

void the_map_is_the_integral_of_the_frequency(void**) {
  Random random(1);
  for (int tries = 0; tries < 200; ++tries) {
    const Knots knots = random_knots(random);
    const GradedPeriod period(1, knots);
    for (int n = 0; n < 50; ++n) {
      const double s = n % 5 ? random.between(-9, 25) : knots[random.below(knots.size())].position;
      const double expected = integral(knots, 0, s), u = period.cells(s);
      if (std::abs(u - expected) > 1e-12 * (1 + std::abs(expected)))
        fail_msg("%.17g is in cell %.17g, not %.17g", s, u, expected);
      const double f = frequency_at(knots, s);
      assert_true(std::abs(period.frequency(s) - f) < 1e-11 * f);
    }
    assert_true(std::abs(period.cells(0)) <= period.error(0));
  }
}

void bounds_hold_in_intervals(void**) {
  Random random(2);
  for (int tries = 0; tries < 400; ++tries) {
    const Knots knots = random_knots(random);
    const GradedPeriod period(0, knots);
    const double low = random.between(-9, 20), high = low + random.between(0, 6);
    const GradedPeriod::Bounds bounds = period.over({low, high});
    for (int n = 0; n < 40; ++n) {
      const double s = random.between(low, high), d = random.between(low, high) - s;
      const double change = period.cells(s + d) - period.cells(s);
      const double error = 2 * period.error(std::abs(period.cells(s)) + std::abs(change));
      assert_true(std::abs(change) <= bounds.most * std::abs(d) + error);
      assert_true(std::abs(change) >= bounds.least * std::abs(d) - error);
      assert_true(std::abs(change - period.frequency(s) * d) <=
                  bounds.bend * d * d + error + 1e-14 * std::abs(change));
    }
    // The nearest place where the frequency is above a limit, by samples.
    const double limit = std::exp(random.between(-2, 2)), s = random.between(-8, 20);
    const double reach = period.distance_to(s, limit, 4);
    assert_true(reach >= 0 && reach <= 4);
    double nearest = 4;
    for (int n = -4000; n <= 4000; ++n)
      if (frequency_at(knots, s + 1e-3 * n) > limit * (1 + 1e-12))
        nearest = std::min(nearest, 1e-3 * std::abs(n));
    for (const auto& knot : knots)
      if (1 / knot.cell_size > limit * (1 + 1e-12))
        nearest = std::min(nearest, std::abs(knot.position - s));
    if (reach > nearest + 1e-9 || reach < nearest - 1.1e-3)
      fail_msg("frequencies above %g are %g away from %g, not %g", limit, nearest, s, reach);
  }
}

Ref<Functional> gyroid(const Knots& knots, FunctionalKind kind, Parameter level) {
  return make_ref<Functional>(Neighbourhood{}, parse_expression(preset_expressions[0], {}), kind,
                              std::move(level), 0, GradedPeriod(2, knots));
}

/// One knot is a plain grid; far from the others, so is the space beyond the ends.
void a_constant_size_is_that_of_the_grid(void**) {
  Neighbourhood grid;
  grid.cell_size.z = 0.5;
  const Tape tape = parse_expression(preset_expressions[0], {});
  const Functional plain(grid, tape, FunctionalKind::sheet, Parameter(0.3), 0);
  const Ref<Functional> graded = gyroid({{3, 0.5}}, FunctionalKind::sheet, Parameter(0.3));
  Random random(3);
  for (size_t i = 0; i < 20000; ++i) {
    const Vec3 p = random.in_box({{-4, -4, -4}, {4, 4, 4}});
    assert_int_equal(graded->inside(p), plain.inside(p));
    assert_true(graded->cell_of(p) == plain.neighbourhood().locate(p).cell);
  }
  assert_true(graded->characteristic_length() == 1);
}

/// Distances in the large cells are not those of the smallest ones.
void distances_are_those_of_the_cells_nearby(void**) {
  const Ref<Functional> graded =
      gyroid({{0, 1}, {20, 1}, {21, 0.0625}}, FunctionalKind::network, Parameter(0.0));
  const Functional plain({}, parse_expression(preset_expressions[0], {}), FunctionalKind::network,
                         Parameter(0.0), 0);
  Random random(4);
  for (size_t i = 0; i < 300; ++i) {
    const Vec3 p = random.in_box({{0, 0, 1}, {3, 3, 18}});
    const double d = graded->distance_bound(p), near = plain.distance_bound(p);
    assert_true(std::abs(d - near) <= 1e-9 + 1e-6 * near);
  }
}

/// Functions that jump at the cells' borders: rays stop there.
void rays_meet_the_borders_of_cells(void**) {
  for (const char* text : {"0.15*x-0.2*cos(y/2)+0.1*cos(z)", "z-x/4", "abs(z-3)+0.2*sin(y)"})
    for (const int axis : {0, 2}) {
      const Knots knots = {{-1, 0.6}, {0.2, 0.3}, {0.21, 0.5}, {1.5, 1.1}};
      const Functional solid({}, parse_expression(text, {}), FunctionalKind::network,
                             Parameter(0.4), 0, GradedPeriod(axis, knots));
      Random random(static_cast<uint64_t>(axis) + 9);
      for (size_t i = 0; i < test_count(60) + 4; ++i) {
        const Vec3 a = random.in_box({{-1, -1, -1}, {2, 2, 2}});
        Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        if (i % 4 == 0) way = axis == 0 ? Vec3{1, 0, 0} : Vec3{0, 0, -1};
        check_ray(
            text, {a, way * (1 / length(way))}, 0, 3, RayWalk{4 * solid.ray_tolerance(), 300},
            [&](Vec3 p) { return solid.inside(p); },
            [&](const Ray& r, double first, double last, double& t) {
              RaySearch search{r, first, last};
              solid.enter(&search, 1, nullptr);
              t = search.t;
              return search.found;
            },
            [&](const Ray& r, double first, double last) {
              return solid.leave(r, first, last, nullptr);
            });
      }
      // Within the distance of a point membership does not change.
      for (size_t i = 0; i < test_count(2000) + 50; ++i) {
        const Vec3 p = random.in_box({{-2, -2, -2}, {3, 3, 3}});
        const double d = solid.distance_bound(p);
        for (int n = 0; n < 10; ++n) {
          const Vec3 off = random.in_box({{-1, -1, -1}, {1, 1, 1}});
          const Vec3 q = p + off * (d * (1 - 1e-9) / length(off));
          if (solid.inside(q) != solid.inside(p))
            fail_msg("%s: membership changes within %g of (%.17g, %.17g, %.17g)", text, d, p.x, p.y,
                     p.z);
        }
      }
    }
}

/// The level along the axis is that of the cells there.
void a_thickness_keeps_its_walls(void**) {
  const Tape tape = parse_expression(preset_expressions[0], {});
  const GradedPeriod period(0, {{0, 0.5}, {1, 2.0}, {1.5, 0.7}});
  Neighbourhood grid;
  grid.origin = {1, 2, 3};
  const Parameter level = graded_wall_level(tape, grid, period, 0.08);
  for (const double s : {-1.0, 0.0, 0.3, 0.62, 1.0, 1.2, 1.5, 4.0}) {
    const double size = 1 / period.frequency(s);
    const WallThickness walls(tape, {size, 1, 1});
    const double expected = walls.levels()(0.08);
    if (std::abs(level.at({1 + s, 5, 5}) - expected) > 0.004 * expected)
      fail_msg("level %g at %g, not %g", level.at({1 + s, 5, 5}), s, expected);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_map_is_the_integral_of_the_frequency),
      cmocka_unit_test(bounds_hold_in_intervals),
      cmocka_unit_test(a_constant_size_is_that_of_the_grid),
      cmocka_unit_test(distances_are_those_of_the_cells_nearby),
      cmocka_unit_test(rays_meet_the_borders_of_cells),
      cmocka_unit_test(a_thickness_keeps_its_walls),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
