// SPDX-License-Identifier: Apache-2.0
// Level lines of functional structures in a plane, and paths along them: points are on the level,
// lines stay within the tolerance, and nothing is lost: signs of the function on a fine grid change
// where lines are.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/pi.h"
#include "expression/parser.h"
#include "field/gradient.h"
#include "fill/chain.h"
#include "fill/line_density.h"
#include "msq_test.h"
#include "random.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr Box2 everywhere{{-1e9, -1e9}, {1e9, 1e9}};

Rotation turned() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
}

Ref<Functional> make(const std::string& text, FunctionalKind kind, const Neighbourhood& grid = {},
                     Parameter level = Parameter(0.3)) {
  return make_ref<Functional>(grid, parse_expression(text, {}), kind, std::move(level), 1);
}

double value(const Functional& f, Vec3 p) {
  const Vec3 u = f.neighbourhood().locate(p).fraction;
  return evaluate(f.function(), {u.x * 2 * pi, u.y * 2 * pi, u.z * 2 * pi}) -
         (f.is_sheet() ? 0 : f.level().at(p));
}

double slope(const Functional& f, Vec3 p, double step) {
  const double x = value(f, p + Vec3{step, 0, 0}) - value(f, p - Vec3{step, 0, 0});
  const double y = value(f, p + Vec3{0, step, 0}) - value(f, p - Vec3{0, step, 0});
  return std::hypot(x, y) / (2 * step);
}

/// The distance to the level along the steepest way, by the value and the slope; infinity where it
/// is too flat to tell.
double distance_to_level(const Functional& f, Vec2 p, double z) {
  const Vec3 at{p.x, p.y, z};
  const double cell = min_component(f.neighbourhood().cell_size), s = slope(f, at, 1e-5 * cell);
  return s * cell < 0.8 ? 0 : std::abs(value(f, at)) / s;
}

/// How many lines cross the way from p to q.
size_t crossings(const LineGraph& graph, Vec2 p, Vec2 q) {
  size_t count = 0;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 from = graph.points[a], to = graph.points[b];
    const bool splits = (cross(q - p, from - p) > 0) != (cross(q - p, to - p) > 0);
    const bool is_split = (cross(to - from, p - from) > 0) != (cross(to - from, q - from) > 0);
    count += splits && is_split;
  }
  return count;
}

void check(const char* name, const Functional& f, double z, const Box2& window) {
  const double cell = min_component(f.neighbourhood().cell_size);
  for (const double tolerance : {1e-2 * cell, 1e-3 * cell, 5e-5 * cell}) {
    const LineGraph graph = f.wall_lines({z, window, tolerance});
    assert_true(graph.lines.size() > 10);
    for (const Vec2 p : graph.points)
      if (distance_to_level(f, p, z) > 0.03 * tolerance + 1e-9 * cell)
        fail_msg("%s: a point is %g off the level", name, distance_to_level(f, p, z));
    double most = 0;
    for (const auto& [a, b] : graph.lines)
      for (const double t : {0.25, 0.5, 0.75}) {
        const Vec2 p = graph.points[a] + (graph.points[b] - graph.points[a]) * t;
        if (window.contains(p)) most = std::max(most, distance_to_level(f, p, z));
      }
    if (most > tolerance) fail_msg("%s: a line is %g off, tolerance %g", name, most, tolerance);
    // What a path loses of its points stays within the tolerance that is given.
    for (Polyline path : chain(graph)) {
      const CountedVector<Vec2> all = path.points;
      simplify(path, tolerance, everywhere);
      assert_true(path.points.size() <= all.size());
      for (const Vec2 p : all) {
        double least = 1e300;
        const size_t count = path.points.size();
        for (size_t i = 1; i < count + path.is_closed; ++i) {
          const Vec2 from = path.points[i - 1], way = path.points[i % count] - from;
          const double t = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
          least = std::min(least, length(p - from - way * t));
        }
        if (least > tolerance * (1 + 1e-9)) fail_msg("%s: %g of a path lost", name, least);
      }
    }
  }
  // Signs at random pairs of near points against the number of lines between them.
  const LineGraph graph = f.wall_lines({z, window, 1e-4 * cell});
  Random random(9);
  size_t changes = 0;
  for (size_t i = 0; i < test_count(4000); ++i) {
    const Vec2 p{random.between(window.min.x, window.max.x),
                 random.between(window.min.y, window.max.y)};
    const double angle = random.between(0, 2 * pi);
    const Vec2 q = p + Vec2{std::cos(angle), std::sin(angle)} * (0.1 * cell);
    if (!window.contains(q)) continue;
    const double at_p = value(f, {p.x, p.y, z}), at_q = value(f, {q.x, q.y, z});
    if (distance_to_level(f, p, z) < 1e-3 * cell || distance_to_level(f, q, z) < 1e-3 * cell)
      continue;
    const bool is_odd = crossings(graph, p, q) % 2;
    const bool differ = (at_p <= 0) != (at_q <= 0);
    changes += differ;
    if (is_odd != differ) fail_msg("%s: lines and signs differ at %g, %g", name, p.x, p.y);
  }
  assert_true(test_scale() < 1 || changes > 10);
}

void test_lines_are_on_the_level(void**) {
  const Neighbourhood cube{{0.1, -0.2, 0.3}, {2, 2, 2}, {}};
  const Neighbourhood sides{{0.1, -0.2, 0.3}, {2, 3, 1.5}, turned()};
  const Box2 window{{-2.2, -1.7}, {3.1, 2.4}};
  const char* const names[] = {"gyroid", "Schwarz P", "diamond", "I-WP", "Neovius"};
  for (size_t i = 0; i < 5; ++i) {
    check(names[i], *make(preset_expressions[i], FunctionalKind::sheet, cube), 0.71, window);
    check(names[i], *make(preset_expressions[i], FunctionalKind::network, sides), 0.2, window);
  }
  const auto ramp = make_ref<GradientField>(Vec3{-3, 0, 0}, -0.5, Vec3{3, 1, 0}, 0.5);
  check("by a field",
        *make(preset_expressions[0], FunctionalKind::network, cube,
              Parameter(Ref<const Field>(ramp))),
        0.4, window);
}

void test_saddles_are_joined_as_their_middle_is(void**) {
  // sin x sin y = c has the two branches of a hyperbola about 0, of which a square in the middle of
  // which 0 is sees nothing but its corners.
  const double half = 0.5 / 32;
  const Neighbourhood grid{{half, half, 0}, {1, 1, 1}, {}};
  for (const double c : {0.003, -0.003}) {
    const auto f = make("sin(x)*sin(y)", FunctionalKind::network, grid, Parameter(c));
    const LineGraph graph = f->wall_lines({0, {{-0.4, -0.4}, {0.4, 0.4}}, 1e-3});
    const Vec2 middle{half, half}, up{0.8 * half, 0.8 * half}, down{0.8 * half, -0.8 * half};
    assert_int_equal(crossings(graph, middle - up, middle + up), c > 0 ? 2 : 0);
    assert_int_equal(crossings(graph, middle - down, middle + down), c > 0 ? 0 : 2);
  }
}

/// A shear outwards makes cells around an axis half as wide as they are long, so that squares are
/// half as large: the lines along the x axis are apart by one and a half of them.
void test_lines_of_sheared_cells(void**) {
  constexpr double shear = 1.75;
  const auto f = make_ref<Functional>(
      Neighbourhood{}, parse_expression("sin(12*y)", {}), FunctionalKind::sheet, Parameter(0.1), 0,
      Warp(Warp::Kind::cylindrical, {}, Warp::Shell{6, 0, 1, 4, shear, 0}));
  const LineGraph graph = f->wall_lines({0.3, {{1.1, -0.2}, {3.3, 0.2}}, 1e-4});
  // 24 to a cell.
  assert_int_equal(crossings(graph, {1.2, 0.01}, {3.2, 0.01}), 24 * 2 * shear);
}

void test_a_circle(void**) {
  // (x - pi)^2 + (y - pi)^2 = 4, in a cell of 2 pi: one closed path of length 4 pi in each cell.
  // The function jumps at the cells' borders, without a line there.
  const Neighbourhood grid{{0, 0, 0}, {2 * pi, 2 * pi, 2 * pi}, {}};
  const auto f = make("(x-pi)^2+(y-pi)^2-4", FunctionalKind::sheet, grid);
  const LineGraph graph = f->wall_lines({1, {{0, 0}, {4 * pi, 2 * pi}}, 1e-5});
  CountedVector<Polyline> paths = chain(graph);
  assert_int_equal(paths.size(), 2);
  for (Polyline& path : paths) {
    assert_true(path.is_closed);
    double sum = 0;
    for (size_t i = 0; i < path.points.size(); ++i)
      sum += length(path.points[i] - path.points[(i + 1) % path.points.size()]);
    assert_true(std::abs(sum - 4 * pi) < 1e-4);
    const size_t before = path.points.size();
    // An arc of 4 sqrt(1e-5) is 1e-5 from its chord: 994 lines would do.
    if (before > 4 * 994) fail_msg("%zu points to a circle", before);
    simplify(path, 1e-2, everywhere);
    assert_true(path.points.size() < before / 4 && path.points.size() >= 20);
  }
}

void test_a_jump_is_no_wall(void**) {
  // x - pi - 1 passes 0 once in a cell, and jumps from above to below at its border.
  const auto sheet = make("x-pi-1", FunctionalKind::sheet);
  const auto network = make("x-pi-1", FunctionalKind::network, {}, Parameter(0.0));
  const WallSection section{0.5, {{0.1, 0.1}, {2.9, 0.9}}, 1e-3};
  const CountedVector<Polyline> walls = chain(sheet->wall_lines(section)),
                                borders = chain(network->wall_lines(section));
  assert_int_equal(walls.size(), 3);
  assert_int_equal(borders.size(), 5);
  for (const Polyline& wall : walls) {
    const double x = wall.points[0].x - std::floor(wall.points[0].x);
    assert_true(std::abs(x - (pi + 1) / (2 * pi)) < 1e-6);
  }
}

/// Whatever the heights on both sides: also of 0.001 and 0.999, and where one passes 0 on its way.
void test_no_height_of_a_jump_is_a_wall(void**) {
  const Box2 window{{-0.9, -0.9}, {0.9, 0.9}};
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const WallSection section{0.3, window, tolerance};
    for (const char* text :
         {"ceil(x)-round(y)+0.1", "floor(x)-floor(y)+0.1", "floor(x)-floor(y)+0.5",
          "floor(x)-floor(y)+0.001", "floor(x)-floor(y)+0.000001", "floor(x)-floor(y)+0.999",
          "floor(x)+floor(y)-5.5", "floor(3*sin(x)*sin(y))+0.2", "select(x*x+y*y-10,1,-0.01)",
          // A jump between a node inside and one without a value.
          "select(x-4.33,select(x-4.40,sqrt(-1-x*x),0.9),-0.1)"}) {
      const LineGraph graph = make(text, FunctionalKind::sheet)->wall_lines(section);
      if (!graph.lines.empty()) fail_msg("%s: %zu lines", text, graph.lines.size());
    }
    // Passes 0 at y = pi, and jumps from y - pi to y - pi - 7 or + 7 along x.
    const LineGraph graph = make("y-pi+7*select(x-2,1,0)-7*select(x-4,1,0)", FunctionalKind::sheet)
                                ->wall_lines(section);
    assert_true(!graph.lines.empty());
    for (const auto& [a, b] : graph.lines)
      for (const uint32_t end : {a, b}) {
        const double y = graph.points[end].y - std::floor(graph.points[end].y);
        if (std::abs(y - 0.5) > 1e-3) fail_msg("a wall at y = %g of the cell", y);
      }
  }
}

/// Walls are found where the function is steep: from -1 to 1 within some 1e-6 squares.
void test_steep_functions_have_walls(void**) {
  for (const double tolerance : {1e-2, 1e-6}) {
    const auto f = make("tanh(10000000*(x-1.1))+0.9", FunctionalKind::sheet);
    const LineGraph graph = f->wall_lines({0.3, {{0.1, 0.1}, {0.9, 0.9}}, tolerance});
    assert_int_equal(crossings(graph, {0.05, 0.47}, {0.95, 0.47}), 1);
  }
}

void test_paths_end_where_lines_meet(void**) {
  // A T with a bend in its bar and another in its stem, and a triangle.
  LineGraph graph;
  graph.points = {{0, 0}, {1, 0.1}, {2, 0}, {1, 1}, {5, 5}, {6, 5}, {5, 6}, {1.2, 2}};
  graph.lines = {{1, 3}, {0, 1}, {1, 2}, {4, 5}, {5, 6}, {6, 4}, {3, 7}};
  const CountedVector<Polyline> paths = chain(graph);
  assert_int_equal(paths.size(), 4);
  assert_int_equal(paths[0].points.size(), 3);
  assert_int_equal(paths[1].points.size(), 2);
  assert_int_equal(paths[2].points.size(), 2);
  assert_true(paths[3].is_closed);
  assert_int_equal(paths[3].points.size(), 3);
}

void test_points_within_a_distance_are_one(void**) {
  LineGraph graph;
  graph.points = {{0, 0}, {1, 0}, {1 + 1e-9, 1e-9}, {2, 0}, {1, -1e-9}, {0, 1e-10}};
  graph.lines = {{0, 1}, {2, 3}, {4, 1}, {5, 2}};
  graph.weld(1e-8);
  assert_int_equal(graph.points.size(), 3);
  assert_int_equal(graph.lines.size(), 2);
  const CountedVector<Polyline> paths = chain(graph);
  assert_int_equal(paths.size(), 1);
  assert_int_equal(paths[0].points.size(), 3);
}

/// Against the mean over all heights of what a plane of the cell shows by itself.
void test_mean_length(void**) {
  // Planes x = constant: 1 per cell size, at any size; turned about y by a quarter of a right
  // angle, each is longer in the plane by 1, and the cell 1 / cos as wide.
  for (const double size : {1.0, 4.0}) {
    const auto f = make("x-pi", FunctionalKind::sheet, {{0, 0, 0}, {size, size, size}, {}});
    assert_true(std::abs(mean_line_density(*f) * size - 1) < 1e-3);
    const double c = std::cos(0.4), s = std::sin(0.4);
    const auto g = make("x-pi", FunctionalKind::sheet,
                        {{0, 0, 0}, {size, size, size}, {{c, 0, s, 0, 1, 0, -s, 0, c}}});
    assert_true(std::abs(mean_line_density(*g) * size - c) < 0.03);
  }
  // By Crofton's formula the length per area is pi / 2 times the crossings of random straight lines
  // per length.
  Random random(4);
  for (const int preset : {0, 3}) {
    const auto f = make(preset_expressions[preset], FunctionalKind::sheet);
    const double density = mean_line_density(*f);
    const size_t lines = test_count(20000), steps = 150;
    size_t crossings = 0;
    for (size_t i = 0; i < lines; ++i) {
      const Vec3 p = random.in_box({{0, 0, 0}, {1, 1, 1}});
      const double angle = random.between(0, 2 * pi);
      bool last = false;
      for (size_t k = 0; k <= steps; ++k) {
        const double t = 2.0 * static_cast<double>(k) / steps;
        const bool now = value(*f, p + Vec3{std::cos(angle), std::sin(angle), 0} * t) <= 0;
        crossings += k > 0 && now != last;
        last = now;
      }
    }
    const double known = pi / 2 * static_cast<double>(crossings) / (2 * static_cast<double>(lines));
    print_message("function %d: %.5f, by random lines %.5f\n", preset, density, known);
    assert_true(std::abs(density / known - 1) < 0.012 / std::sqrt(std::min(1.0, test_scale())));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_lines_are_on_the_level),
      cmocka_unit_test(test_saddles_are_joined_as_their_middle_is),
      cmocka_unit_test(test_lines_of_sheared_cells),
      cmocka_unit_test(test_a_circle),
      cmocka_unit_test(test_a_jump_is_no_wall),
      cmocka_unit_test(test_no_height_of_a_jump_is_a_wall),
      cmocka_unit_test(test_steep_functions_have_walls),
      cmocka_unit_test(test_paths_end_where_lines_meet),
      cmocka_unit_test(test_points_within_a_distance_are_one),
      cmocka_unit_test(test_mean_length),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
