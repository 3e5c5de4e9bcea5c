// SPDX-License-Identifier: Apache-2.0
// The map to warped cells against that of the C library, its inverse, and its bounds against
// samples.
#include "cell/warp.h"

#include <cmath>

#include "base/pi.h"
#include "expression/parser.h"
#include "random.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int all = 4000;

int tries(int most) {
  return static_cast<int>(std::max(20.0, most * test_scale()));
}

Rotation random_rotation(Random& random) {
  const Vec3 a{random.normal(), random.normal(), random.normal()};
  const Vec3 z = a * (1 / length(a));
  const Vec3 b = cross(z, {random.normal(), random.normal(), random.normal()});
  const Vec3 x = b * (1 / length(b)), y = cross(z, x);
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}};
}

Warp random_warp(Random& random, Warp::Kind kind) {
  Neighbourhood grid;
  grid.cell_size = {std::exp(random.between(-1, 1)), 1, std::exp(random.between(-1, 1))};
  if (random.below(2)) {
    grid.origin = {random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)};
    grid.rotation = random_rotation(random);
  }
  Warp::Shell shell;
  shell.count = static_cast<uint32_t>(1 + random.below(random.below(3) ? 40 : Warp::max_count));
  if (kind == Warp::Kind::spherical)
    shell.count_polar = static_cast<uint32_t>(1 + random.below(random.below(3) ? 20 : 65536));
  shell.inner = random.below(2) ? random.between(0, 3) : 0;
  if (kind == Warp::Kind::cylindrical) {
    if (random.below(3) == 0) shell.shear_outwards = random.between(-3, 3);
    if (random.below(3) == 0) shell.shear_along = random.between(-3, 3);
  }
  return Warp(kind, grid, shell);
}

Warp::Kind kind_of(int n) {
  return n % 2 ? Warp::Kind::spherical : Warp::Kind::cylindrical;
}

/// The difference of v, which closes after count cells.
double around(double a, double b, double count) {
  return std::remainder(a - b, count);
}

void cells_are_those_of_the_formula(void**) {
  Random random(1);
  for (int n = 0; n < tries(all); ++n) {
    const Warp warp = random_warp(random, kind_of(n));
    const auto& shell = warp.shell();
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random.in_box({{-20, -20, -20}, {20, 20, 20}}), g = warp.grid().to_grid(p);
      const Warp::Place place = warp.place(p);
      const bool is_sphere = warp.kind() == Warp::Kind::spherical;
      const double rho = std::hypot(g.x, g.y), r = is_sphere ? std::hypot(rho, g.z) : rho;
      const Vec3 size = warp.grid().cell_size;
      assert_true(std::abs(place.radius - r) < 1e-13);
      assert_true(std::abs(place.cells.x - (r - shell.inner) / size.x) < 1e-12);
      const double sheared =
          shell.shear_outwards * place.cells.x + shell.shear_along * place.cells.z;
      const double v = shell.count * std::atan2(g.y, g.x) / two_pi + sheared;
      assert_true(std::abs(around(place.cells.y, v, shell.count)) <
                  1e-14 * (shell.count + std::abs(sheared)));
      assert_true(place.cells.y >= 0 && place.cells.y < shell.count);
      const double w =
          is_sphere ? shell.count_polar * (std::atan2(g.z, rho) / pi + 0.5) : g.z / size.z;
      assert_true(std::abs(place.cells.z - w) < (is_sphere ? 1e-14 * shell.count_polar : 1e-12));
      const auto located = warp.locate(place.cells);
      for (int axis = 0; axis < 3; ++axis)
        assert_true(located.fraction[axis] >= 0 && located.fraction[axis] <= 1);
      assert_true(located.cell.y >= 0 && located.cell.y < static_cast<int32_t>(shell.count));
      assert_true(std::abs(located.cell.x + located.fraction.x - place.cells.x) < 1e-12);
      assert_true(std::abs(located.cell.z + located.fraction.z - place.cells.z) < 1e-10);
      const Vec3 back = warp.from_cells(place.cells);
      const double reach = length(p) + 2 * length(warp.grid().origin);
      const double error = shell.is_sheared() ? 2 * warp.slack(p, 0) : 0x1p-46 * reach;
      if (length(back - p) > error)
        fail_msg("%.17g %.17g %.17g came back %g away", p.x, p.y, p.z, length(back - p));
      assert_true(std::abs(warp.axis_distance(p) - rho) < 1e-13);
      assert_true(std::abs(warp.radius(p) - r) < 1e-13);
    }
  }
}

/// On the positive x axis the cells lie as those of the grid.
void axes_are_those_of_the_grid(void**) {
  for (int n = 0; n < 2; ++n) {
    Warp::Shell shell;
    shell.count = 8;
    shell.count_polar = n ? 4 : 0;
    shell.inner = 1;
    const Warp warp(kind_of(n), Neighbourhood(), shell);
    const Vec3 at = warp.to_cells({3, 0, 0});
    assert_true(at == (Vec3{2, 0, n ? 2.0 : 0.0}));
    const double step = 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p{3, 0, 0};
      p[axis] += step;
      const Vec3 change = warp.to_cells(p) - at;
      const double slope = warp.slopes(3, 3)[axis];
      for (int other = 0; other < 3; ++other)
        assert_true(std::abs(change[other] - (axis == other ? step * slope : 0)) < 1e-5);
    }
    assert_true(warp.is_in_shell(1) && !warp.is_in_shell(0.999) && warp.is_in_shell(1e9));
  }
}

void seams_and_poles_are_in_cells(void**) {
  Warp::Shell shell;
  shell.count = 7;
  shell.count_polar = 3;
  const Warp warp(Warp::Kind::spherical, Neighbourhood(), shell);
  // Just below the x axis: a whole turn, rounded.
  assert_true(warp.to_cells({1, -1e-300, 0}).y == 0);
  assert_true(warp.to_cells({1, -0.0, 0}).y == 0);
  assert_true(warp.to_cells({1, -1e-9, 0}).y > 7 - 1e-7);
  for (const double y : {0.0, -0.0})
    assert_true(std::abs(warp.to_cells({-1, y, 0}).y - 3.5) < 1e-14);
  assert_true(warp.to_cells({0, 0, 0}) == (Vec3{0, 0, 1.5}));
  const auto north = warp.locate(warp.to_cells({0, 0, 1}));
  assert_int_equal(north.cell.z, 2);
  assert_true(north.fraction.z == 1);
  const auto south = warp.locate(warp.to_cells({0, 0, -1}));
  assert_int_equal(south.cell.z, 0);
  assert_true(south.fraction.z == 0);
  for (int n = 0; n < 7; ++n) {
    const Vec3 a = warp.from_cells({2, 0.25 + n, 1.25}), b = warp.from_cells({2, 7.25 + n, 1.25}),
               c = warp.from_cells({2, n - 6.75, 1.25});
    assert_true(a == b && a == c);
  }
}

Box3 random_box(Random& random) {
  const double size = std::exp(random.between(-6, 3));
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = random.below(6) ? random.between(-9, 9) : 0;
    box.max[axis] = box.min[axis] + (random.below(5) ? size * random.unit() : 0);
  }
  return box;
}

/// Its slopes bound the gradients of sums of the coordinates, too, as those of functions are.
void sheared_cells_bound_sums_of_gradients(void**) {
  Random random(6);
  double steepest = 0;
  for (int n = 0; n < tries(all); ++n) {
    const Warp warp = random_warp(random, Warp::Kind::cylindrical);
    const Vec3 p = random.in_box({{-12, -12, -12}, {12, 12, 12}});
    const double rho = warp.axis_distance(p);
    if (!(rho > 0.01)) continue;
    const auto of_cells = warp.gradients(p);
    const Vec3 slopes = warp.slopes(rho, rho);
    const Vec3 by{random.normal() / slopes.x, random.normal() / slopes.y,
                  random.normal() / slopes.z};
    const double sum = length(of_cells[0] * by.x + of_cells[1] * by.y + of_cells[2] * by.z);
    const double most = length(by * slopes);
    assert_true(sum <= most * (1 + 1e-12));
    steepest = std::max(steepest, sum / most);
  }
  assert_true(steepest > 0.5);
}

void images_contain_the_cells_of_points(void**) {
  Random random(2);
  double wide = 0;
  for (int n = 0; n < tries(2 * all); ++n) {
    const Warp warp = random_warp(random, kind_of(n / 2));
    Box3 box = random_box(random);
    if (n % 2) {  // about the axis or the centre
      const Vec3 at = warp.grid().from_grid(Vec3{0, 0, random.between(-1, 1)}),
                 half = box.extent() * 0.6;
      box = {at - half, at + half};
    }
    const Warp::Image image = warp.image(box);
    const double count = warp.shell().count;
    assert_true(image.cells.max.y - image.cells.min.y <= count);
    wide += image.cells.max.y - image.cells.min.y < count;
    for (int i = 0; i < 30; ++i) {
      Vec3 p = random.in_box(box);
      if (i % 3 == 0)
        for (int axis = 0; axis < 3; ++axis)
          if (random.below(2)) p[axis] = random.below(2) ? box.min[axis] : box.max[axis];
      const Warp::Place place = warp.place(p);
      const Vec3 low = image.cells.min, high = image.cells.max, c = place.cells;
      if (!(c.x >= low.x && c.x <= high.x && c.z >= low.z && c.z <= high.z))
        fail_msg("(%.17g, %.17g, %.17g) is in %.17g and %.17g", p.x, p.y, p.z, c.x, c.z);
      const auto is_in = [&](double v) { return v >= low.y && v <= high.y; };
      if (!is_in(c.y) && !is_in(c.y - count) && !is_in(c.y + count))
        fail_msg("v is %.17g, not from %.17g to %.17g", c.y, low.y, high.y);
      assert_true(place.radius >= image.radius.low && place.radius <= image.radius.high);
      assert_true(warp.axis_distance(p) >= image.axis_distance);
    }
    // Small boxes have small images.
    const double size = max_component(box.extent());
    const Vec3 slope = warp.slopes(image.axis_distance, image.radius.low);
    const Vec3 extent = image.cells.extent();
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(slope[axis])) assert_true(extent[axis] <= 6 * slope[axis] * (size + 1e-9));
  }
  assert_true(wide > 10);
}

/// No step changes a coordinate by more than the slope, within that distance of the axis.
void slopes_bound_the_change(void**) {
  Random random(3);
  double steepest = 0;
  for (int n = 0; n < tries(all); ++n) {
    const Warp warp = random_warp(random, kind_of(n));
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random.in_box({{-12, -12, -12}, {12, 12, 12}});
      const double step = std::exp(random.between(-8, 0));
      const Vec3 way{random.normal(), random.normal(), random.normal()};
      const Vec3 q = p + way * (step / length(way));
      const double rho = warp.axis_distance(p) - step, r = warp.radius(p) - step;
      if (!(rho > 0)) continue;
      const Vec3 a = warp.to_cells(p), b = warp.to_cells(q), slope = warp.slopes(rho, r);
      const Vec3 change{std::abs(a.x - b.x), std::abs(around(a.y, b.y, warp.shell().count)),
                        std::abs(a.z - b.z)};
      for (int axis = 0; axis < 3; ++axis) {
        const double most = slope[axis] * (step + warp.slack(p, step));
        assert_true(change[axis] <= most);
        steepest = std::max(steepest, change[axis] / most);
      }
    }
  }
  assert_true(steepest > 0.5);
}

/// Along lines: the gradients give the first derivatives, and the bends bound the rest.
void bends_bound_the_departure_from_lines(void**) {
  Random random(4);
  double most_bent[3] = {};
  for (int n = 0; n < tries(all); ++n) {
    const Warp warp = random_warp(random, kind_of(n));
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random.in_box({{-12, -12, -12}, {12, 12, 12}});
      const double step = 0.5 * random.unit() * warp.axis_distance(p);
      const Vec3 d{random.normal(), random.normal(), random.normal()};
      const Vec3 way = d * (step / length(d));
      const double rho = warp.axis_distance(p) - step, r = warp.radius(p) - step;
      const Vec3 bends = warp.bends(rho, r), slopes = warp.slopes(rho, r);
      const auto gradients = warp.gradients(p);
      const Vec3 a = warp.to_cells(p), b = warp.to_cells(p + way);
      for (int axis = 0; axis < 3; ++axis) {
        assert_true(length(gradients[static_cast<size_t>(axis)]) <= slopes[axis]);
        const double line = a[axis] + dot(gradients[static_cast<size_t>(axis)], way);
        const double off =
            std::abs(axis == 1 ? around(b.y, line, warp.shell().count) : b[axis] - line);
        const double most = 0.5 * bends[axis] * step * step;
        if (off > most + slopes[axis] * 3 * warp.slack(p, step))
          fail_msg("coordinate %d departs by %g, not by at most %g", axis, off, most);
        if (most > 1e-6) most_bent[axis] = std::max(most_bent[axis], off / most);
      }
    }
  }
  for (const double bent : most_bent) assert_true(bent > 0.3);
}

/// Also over the seam, where the last cell around meets the first.
void functions_run_on_over_borders_of_cells(void**) {
  Random random(5);
  for (int n = 0; n < tries(400); ++n) {
    const Warp warp = random_warp(random, kind_of(n));
    if (warp.shell().count > 100 || warp.shell().count_polar > 100) continue;
    const Functional solid(warp.grid(), parse_expression(preset_expressions[0], {}),
                           FunctionalKind::network, Parameter(0.1), 1, warp);
    for (int i = 0; i < 60; ++i) {
      Vec3 cells{random.between(1, 4), random.between(0, warp.shell().count),
                 random.between(0.2, std::max(0.8, warp.shell().count_polar - 0.2))};
      const int axis = static_cast<int>(random.below(3));
      cells[axis] = axis == 1 && i % 2 ? 0 : std::ceil(cells[axis]);
      const Vec3 p = warp.from_cells(cells);
      const double steepest = 2 * two_pi * max_component(warp.slopes(warp.axis_distance(p) / 2, 0));
      for (int to = 0; to < 6; ++to) {
        Vec3 q = p;
        q[to % 3] += to < 3 ? 1e-12 : -1e-12;
        const double change = std::abs(solid.onset(q) - solid.onset(p));
        if (!(change <= 1e-11 * steepest)) fail_msg("the function jumps by %g", change);
      }
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(cells_are_those_of_the_formula),
      cmocka_unit_test(axes_are_those_of_the_grid),
      cmocka_unit_test(seams_and_poles_are_in_cells),
      cmocka_unit_test(sheared_cells_bound_sums_of_gradients),
      cmocka_unit_test(images_contain_the_cells_of_points),
      cmocka_unit_test(slopes_bound_the_change),
      cmocka_unit_test(bends_bound_the_departure_from_lines),
      cmocka_unit_test(functions_run_on_over_borders_of_cells),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
