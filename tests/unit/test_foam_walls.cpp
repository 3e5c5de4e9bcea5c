// SPDX-License-Identifier: Apache-2.0
// Walls of closed-cell foams against their definition: distances to the planes between the nearest
// seed and every other seed of a large block, in extended precision.
#include <algorithm>
#include <vector>

#include "cell/context.h"
#include "field/gradient.h"
#include "graded_cells.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/walled_foam.h"

using namespace msq;
using namespace msq::test;

namespace {

using Real = long double;

Ref<Context> context() {
  static const Ref<Context> made = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return made;
}

/// Twice the distance from q to the nearest face, by all of the seeds.
Real brute_onset(const std::vector<Vec3>& seeds, Vec3 q) {
  const auto squared = [&](Vec3 s) {
    const Real x = Real(s.x) - q.x, y = Real(s.y) - q.y, z = Real(s.z) - q.z;
    return x * x + y * y + z * z;
  };
  size_t nearest = 0;
  for (size_t i = 0; i < seeds.size(); ++i)
    if (squared(seeds[i]) < squared(seeds[nearest])) nearest = i;
  const Vec3 a = seeds[nearest];
  const Real own = squared(a);
  Real least = 1e30L;
  for (size_t i = 0; i < seeds.size(); ++i) {
    if (i == nearest) continue;
    const Real x = Real(seeds[i].x) - a.x, y = Real(seeds[i].y) - a.y, z = Real(seeds[i].z) - a.z;
    least = std::min(least, (squared(seeds[i]) - own) / std::sqrt(x * x + y * y + z * z));
  }
  return least;
}

struct Tally {
  size_t asked = 0, inside = 0, wrong = 0, near = 0;
  double worst = 0;  // error of the onset, in cells

  void check(bool is_inside, double onset, Real brute, double thickness, double slack) {
    ++asked;
    inside += is_inside;
    worst = std::max(worst, std::abs(static_cast<double>(onset - brute)));
    if (std::abs(static_cast<double>(brute - thickness)) <= slack)
      ++near;
    else
      wrong += is_inside != (brute <= thickness);
    wrong += is_inside != (onset <= thickness);
  }
  void expect_right(const char* name, double slack) const {
    print_message("%s: %zu points, %zu inside, %zu wrong, %zu within %g, onset off by %g\n", name,
                  asked, inside, wrong, near, slack, worst);
    assert_int_equal(wrong, 0);
    assert_true(worst <= slack && inside > 0 && inside < asked && near < 3);
  }
};

void test_one_seed_a_cell(void**) {
  struct Case {
    const char* name;
    double jitter;
    Vec3 scale;
    double slack;
  };
  // A tie of seeds at jitter 0 is one of planes too: no point is near to rounding but on a face.
  const Case cases[] = {{"cubes", 1, {1, 1, 1}, 1e-14},
                        {"cubes, jitter 0.3", 0.3, {1, 1, 1}, 1e-14},
                        {"cubes, jitter 0.01", 0.01, {1, 1, 1}, 1e-14},
                        {"cubes, jitter 0", 0, {1, 1, 1}, 1e-14},
                        {"unlike sides", 1, {1, 0.7, 0.4}, 1e-12},
                        {"flat", 1, {1, 1, 0.25}, 1e-12}};
  for (const Case& c : cases) {
    Tally tally;
    Random random(17);
    for (size_t cell_number = 0; cell_number < 40; ++cell_number) {
      const FoamSeeds seeds(cell_number, c.jitter, c.scale);
      const NearSeeds near(seeds, nullptr);
      const CellIndex home{static_cast<int32_t>(random.below(2000)) - 1000,
                           static_cast<int32_t>(random.below(2000)) - 1000, -7};
      std::vector<Vec3> all;
      int half[3];
      for (int axis = 0; axis < 3; ++axis)
        half[axis] = static_cast<int>(std::ceil(2.75 / c.scale[axis]));
      for (int z = -half[2]; z <= half[2]; ++z)
        for (int y = -half[1]; y <= half[1]; ++y)
          for (int x = -half[0]; x <= half[0]; ++x) all.push_back(seeds.at(home, x, y, z));
      for (size_t i = 0; i < test_count(4000) / 40 + 1; ++i) {
        const Vec3 q = random.in_box({{0, 0, 0}, {1, 1, 1}}) * c.scale;
        const double thickness = random.below(2) ? 0.1 : random.between(0, 1);
        const Real brute = brute_onset(all, q);
        tally.check(is_in_wall(near, home, q, thickness), find_nearest_face(near, home, q).onset,
                    brute, thickness, c.slack);
      }
    }
    tally.expect_right(c.name, c.slack);
  }
}

/// Seeds at the centres of cells: faces are those of the grid.
void test_without_jitter(void**) {
  const FoamWalls walls(context(), {}, Parameter(0.2), 0, 3);
  Random random(2);
  for (size_t i = 0; i < test_count(20000); ++i) {
    const Vec3 p = random.in_box({{-5, -5, -5}, {5, 5, 5}});
    double least = 1;
    for (int axis = 0; axis < 3; ++axis)
      least = std::min(least, std::abs(p[axis] - std::round(p[axis])));
    assert_true(std::abs(walls.onset(p) - 2 * least) <= 1e-14);
    if (std::abs(least - 0.1) > 1e-12) assert_int_equal(walls.inside(p), least < 0.1);
    // Exact in the voids; inside, the way to the void where that is across the wall.
    const double distance_bound = walls.distance_bound(p);
    assert_true(distance_bound <= std::abs(least - 0.1));
    assert_true(distance_bound >= std::abs(least - 0.1) - 1e-12);
  }
}

void test_graded_density(void**) {
  const Neighbourhood grid{};
  const Vec3 half{1.5, 1, 0.5};
  const Parameter density(Ref<const Field>(make_ref<GradientField>(half * -1.0, 1.0, half, 40.0)));
  const FoamSeeds cells(5, 1, {1, 1, 1});
  const auto graded = std::make_shared<const GradedSeeds>(cells, grid, density);
  const NearSeeds near(cells, graded);
  std::vector<Vec3> all;
  for (const GradedSeed& seed : graded_cells(*graded, -4, 4)) all.push_back(seed.position);
  Tally tally;
  Random random(3);
  for (size_t i = 0; i < test_count(1000); ++i) {
    const Vec3 p = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    const Neighbourhood::Located at = grid.locate(p);
    const double thickness = random.below(2) ? 0.05 : random.between(0, 0.6);
    const Vec3 corner{double(at.cell.x), double(at.cell.y), double(at.cell.z)};
    const Real brute = brute_onset(all, corner + at.fraction);
    tally.check(is_in_wall(near, at.cell, at.fraction, thickness),
                find_nearest_face(near, at.cell, at.fraction).onset, brute, thickness, 1e-14);
  }
  tally.expect_right("graded", 1e-14);
}

/// A ray meets a wall no earlier and no later than steps of the exact distance say.
void test_rays_meet_walls(void**) {
  const Neighbourhood grid{{0.25, 0.5, 0}, {2, 2, 2}, {}};
  const FoamWalls walls(context(), grid, Parameter(0.1), 1, 9);
  Random random(4);
  size_t met = 0, started_inside = 0, odd = 0;
  double worst = 0;
  for (size_t i = 0; i < test_count(2000); ++i) {
    Vec3 direction = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (i % 7 == 0) direction = {0, 0, random.below(2) ? 1.0 : -1.0};
    direction = direction * (1 / length(direction));
    RaySearch search;
    search.ray = {random.in_box({{-9, -9, -9}, {9, 9, 9}}), direction};
    search.to = i % 5 == 0 ? 0.3 : 20;
    RaySearch marched = search;
    walls.enter(&search, 1, nullptr);
    walls.Structure::enter(&marched, 1, nullptr);
    assert_int_equal(search.found, marched.found);
    if (!search.found) continue;
    ++met;
    worst = std::max(worst, std::abs(search.t - marched.t));
    started_inside += search.t == 0;
    if (search.t == 0) continue;
    const Vec3 n = walls.normal(search.ray, search.t);
    assert_true(std::abs(length(n) - 1) < 1e-12 && dot(n, direction) <= 0);
    // A little outwards, the wall is that much farther; but where another wall is as near.
    const Vec3 p = search.ray.at(search.t);
    odd += std::abs(walls.onset(p + n * 1e-6) - 0.1 - 2e-6) > 1e-9;
  }
  print_message("%zu rays met walls, %zu began in one; apart by %g at most\n", met, started_inside,
                worst);
  assert_true(worst <= 2 * walls.ray_tolerance() && met > 0 && odd <= met / 100);
}

/// Where the slope of the thickness is known, no step is longer than both the distance and the
/// tolerance: even thin walls are met.
void test_steps_miss_no_thin_wall(void**) {
  const FoamWalls walls(context(), {}, Parameter(0.002), 1, 9);
  Random random(14);
  for (size_t i = 0; i < 40 + test_count(200); ++i) {
    RaySearch search;
    search.ray = {random.in_box({{-9, -9, -9}, {9, 9, 9}}), random.direction()};
    search.to = 5;
    RaySearch marched = search;
    walls.enter(&search, 1, nullptr);
    walls.Structure::enter(&marched, 1, nullptr);
    assert_true(search.found && marched.found);
    assert_true(std::abs(search.t - marched.t) <= 2 * walls.ray_tolerance());
  }
}

/// Where the numbers next to each other are farther apart than all other errors, the middle of a
/// box between two of them is one of the two.
void test_boxes_of_neighbouring_numbers(void**) {
  const Neighbourhood grid{{0x1p34, -0x1p34, 0x1p34}, {1, 1, 1}, {}};
  for (const double vent_radius : {0.0, 0.3}) {
    const FoamWalls walls(context(), grid, Parameter(0.2), 1, 9, Parameter(1),
                          Parameter(vent_radius));
    Random random(8);
    size_t changes = 0;
    for (size_t i = 0; i < 200; ++i) {
      const Vec3 start = grid.origin + random.in_box({{-9, -9, -9}, {9, 9, 9}});
      const int axis = static_cast<int>(random.below(3));
      Vec3 low = start, high = start;
      high[axis] += 0.5;
      if (walls.inside(low) == walls.inside(high)) continue;
      for (Vec3 middle = low;;) {
        middle[axis] = 0.5 * (low[axis] + high[axis]);
        if (middle[axis] == low[axis] || middle[axis] == high[axis]) break;
        (walls.inside(middle) == walls.inside(low) ? low : high) = middle;
      }
      ++changes;
      assert_true(walls.classify({low, high}) == BoxClass::mixed);
    }
    assert_true(changes > 20);
  }
}

/// Struts and walls are the union of both.
void test_struts_and_walls(void**) {
  const Neighbourhood grid{{}, {1, 0.8, 1.2}, {}};
  const auto struts =
      make_ref<Foam>(context(), grid, Parameter(0.15), 1.0, uint64_t{3}, FoamMethod::direct);
  const auto walls = make_ref<FoamWalls>(context(), grid, Parameter(0.08), 1.0, uint64_t{3});
  const WalledFoam both(struts, walls);
  Random random(6);
  size_t by_struts = 0, by_walls = 0, count = test_count(2000);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = random.in_box({{-3, -3, -3}, {3, 3, 3}});
    const bool in_struts = struts->inside(p), in_walls = walls->inside(p);
    assert_int_equal(both.inside(p), in_struts || in_walls);
    by_struts += in_struts && !in_walls;
    by_walls += in_walls && !in_struts;
    // Edges are where faces meet: no nearer than the nearest face.
    assert_true(walls->onset(p) <= 2 * struts->onset(p) + 1e-9);
  }
  assert_true(by_struts > count / 100 && by_walls > count / 100);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_one_seed_a_cell),
                              cmocka_unit_test(test_without_jitter),
                              cmocka_unit_test(test_graded_density),
                              cmocka_unit_test(test_rays_meet_walls),
                              cmocka_unit_test(test_steps_miss_no_thin_wall),
                              cmocka_unit_test(test_struts_and_walls),
                              cmocka_unit_test(test_boxes_of_neighbouring_numbers)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
