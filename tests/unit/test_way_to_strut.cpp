// SPDX-License-Identifier: Apache-2.0
// How far rays go on to the next strut of a foam, against membership along them.
#include <vector>

#include "field/gradient.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/foam/rays/march.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  double jitter, radius;
  Vec3 cell_size;
  double slope = 0;  ///< of the radius
};
constexpr Row rows[] = {
    {"thin", 1, 0.02, {1, 1, 1}},
    {"common", 1, 0.1, {1, 1, 1}},
    {"thick", 0.5, 0.25, {1, 1, 1}},
    {"small cells", 1, 1e-4, {1e-3, 1e-3, 1e-3}},
    {"flat cells", 1, 0.05, {1, 1, 0.5}},
    {"little jitter", 0.01, 0.1, {1, 1, 1}},
    {"a gradient", 1, 0.1, {1, 1, 1}, 0.001},
    {"a steep gradient", 1, 0.1, {1, 1, 1}, 0.004},
};

void is_the_way_to_the_surface(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(5);
  const auto context = make_ref<Context>(1u, uint64_t{1} << 20, uint64_t{0});
  const Neighbourhood grid{{0.3, -0.2, 0.1}, row.cell_size, {}};
  Parameter radius(row.radius);
  if (row.slope > 0) {
    const Vec3 half = Vec3{1, 2, 2} * 2;  // 6 long
    radius = Parameter(make_ref<GradientField>(half * -1.0, row.radius - 6 * row.slope, half,
                                               row.radius + 6 * row.slope));
  }
  const Foam foam(context, grid, radius, row.jitter, 3, FoamMethod::automatic);
  const double tolerance = foam.ray_tolerance(), size = min_component(row.cell_size);
  const double left = (row.slope > 0 ? 5e-3 : 1e-4) * size;
  size_t met = 0, slanting = 0, passed = 0;
  for (size_t n = 0; n < test_count(20000); ++n) {
    Ray ray;
    const Vec3 way_on{random.normal(), random.normal(), random.normal()};
    ray.direction = way_on * (1 / length(way_on));
    ray.origin = random.in_box({row.cell_size * -4, row.cell_size * 4});
    if (foam.inside(ray.origin)) continue;
    const double around = foam.distance_bound(ray.origin);
    const double way = way_to_strut(foam, ray.origin, ray.direction, 0);
    constexpr int steps = 16;
    for (int i = 1; i <= steps && way > 0; ++i)
      if (foam.inside(ray.at(way * i / steps)))
        fail_msg("ray %zu is inside at %.17g, its way is %.17g", n, way * i / steps, way);
    if (way >= 0.05 * size - 2 * tolerance) continue;
    // All that is left is the tolerance, and how the radius changes on the way; except for grazes.
    ++met;
    slanting += way > 4 * around;
    passed += !foam.inside(ray.at(way + 2 * tolerance)) && !foam.inside(ray.at(way + left));
  }
  if (test_count(20000) < 20000) return;
  assert_in_range(met, 20, test_count(20000));
  assert_in_range(slanting, 1, met);
  assert_in_range(passed, 0, 1 + met / 100);
}

}  // namespace

int main() {
  std::vector<CMUnitTest> tests;
  for (const Row& row : rows)
    tests.push_back(
        {row.name, is_the_way_to_the_surface, nullptr, nullptr, const_cast<Row*>(&row)});
  return _cmocka_run_group_tests("way_to_strut", tests.data(), tests.size(), nullptr, nullptr);
}
