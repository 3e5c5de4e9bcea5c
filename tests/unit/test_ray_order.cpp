// SPDX-License-Identifier: Apache-2.0
// The order in which rays of an array are cast: each ray once, neighbours close together.
#include "ray/ray_order.h"

#include <algorithm>
#include <numeric>

#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

const Box3 unit_box{{0, 0, 0}, {1, 1, 1}};

FillRays fill_from(const std::vector<RaySearch>& rays, uint64_t first) {
  return [&rays, first](std::span<const uint64_t> numbers, RaySearch* searches) {
    for (size_t n = 0; n < numbers.size(); ++n) searches[n] = rays[numbers[n] - first];
  };
}

/// Rays through the box, and some past it, in random order: parallel or through a point before it.
std::vector<RaySearch> mixed_rays(Random& random, size_t count, bool are_parallel) {
  std::vector<RaySearch> rays(count);
  for (RaySearch& s : rays) {
    const Vec3 through{0.5, random.between(-0.05, 1.05), random.between(-0.05, 1.05)};
    const Vec3 from = are_parallel ? through - Vec3{3, 0.3, 0.1} : Vec3{-3, 0.4, 0.6};
    s.ray = {from, (through - from) * (1 / length(through - from))};
    s.to = 100;
  }
  return rays;
}

/// How far apart rays through the box that follow each other are in its middle, on average.
double mean_gap(const std::vector<RaySearch>& rays, const std::vector<uint64_t>& order) {
  std::vector<Vec3> middles;
  for (const uint64_t i : order) {
    double from = 0, to = 100;
    if (clip_to_box(rays[i].ray, unit_box, from, to))
      middles.push_back(rays[i].ray.at((0.5 - rays[i].ray.origin.x) / rays[i].ray.direction.x));
  }
  double sum = 0;
  for (size_t n = 1; n < middles.size(); ++n) sum += length(middles[n] - middles[n - 1]);
  return sum / static_cast<double>(middles.size() - 1);
}

void test_sorts_rays_by_where_they_go(void**) {
  const Executor executor(2);
  Random random(1);
  constexpr uint64_t first = uint64_t{1} << 40;
  for (const size_t count : {size_t{16}, size_t{1000}, size_t{40000}})
    for (const bool are_parallel : {true, false}) {
      const std::vector<RaySearch> rays = mixed_rays(random, count, are_parallel);
      RayOrder order(unit_box, 1.0 / 128);
      assert_true(order.sort(executor, first, count, fill_from(rays, first), nullptr));
      std::vector<uint64_t> numbers(count);
      order.take(0, numbers);
      for (uint64_t& number : numbers) number -= first;
      std::vector<uint64_t> each = numbers;
      std::sort(each.begin(), each.end());
      for (size_t i = 0; i < count; ++i) assert_int_equal(each[i], i);
      // Of evenly spread points in Morton's order: some 1.6 times the side of each one's square.
      if (count > 100)
        assert_true(mean_gap(rays, numbers) < 3 / std::sqrt(static_cast<double>(count)));
    }
}

void test_leaves_rays_that_lie_together(void**) {
  const Executor executor(2);
  std::vector<RaySearch> rays(10000);
  for (size_t i = 0; i < rays.size(); ++i) {
    const double x = static_cast<double>(i % 100) / 100, y = static_cast<double>(i / 100) / 100;
    rays[i].ray = {{x, y, -1}, {0, 0, 1}};
    rays[i].to = 10;
  }
  assert_false(
      RayOrder(unit_box, 0.25).sort(executor, 0, rays.size(), fill_from(rays, 0), nullptr));
  assert_true(RayOrder(unit_box, 0.05).sort(executor, 0, rays.size(), fill_from(rays, 0), nullptr));
  // Past the box they need no order.
  for (RaySearch& s : rays) s.ray.origin.z = 2;
  assert_false(
      RayOrder(unit_box, 0.05).sort(executor, 0, rays.size(), fill_from(rays, 0), nullptr));
  assert_false(RayOrder(unit_box, 0.05).sort(executor, 0, 1, fill_from(rays, 0), nullptr));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_sorts_rays_by_where_they_go),
      cmocka_unit_test(test_leaves_rays_that_lie_together),
  };
  return cmocka_run_group_tests_name("ray_order", tests, nullptr, nullptr);
}
