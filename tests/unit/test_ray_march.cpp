// SPDX-License-Identifier: Apache-2.0
// Marches along rays: what they find, and how often they ask where the distance is next to nothing.
#include "base/march_together.h"
#include "base/pi.h"
#include "base/ray.h"
#include "random.h"
#include "structure/host/host_function.h"
#include "suite.h"

using namespace msq;

namespace {

const Ray ray{{0, 0, 0}, {1, 0, 0}};
constexpr double tolerance = 0x1p-36;

struct March {
  bool found = false, creeps = false;
  double t = 0;
  int asked = 0;
};

/// Along [0, to] of the ray, with the solid that is at x >= surface, by a bound of the distance.
template <class DistanceBound>
March march(double surface, double to, DistanceBound&& distance_bound) {
  March m;
  const auto inside = [&](Vec3 p) {
    ++m.asked;
    return p.x >= surface;
  };
  m.found = RayMarch{tolerance, tolerance}.find(true, ray, 0, to, inside, distance_bound, m.t,
                                                nullptr, &m.creeps);
  return m;
}

void test_steps_by_the_distance(void**) {
  const March m = march(5, 10, [](Vec3 p) { return std::abs(5 - p.x); });
  assert_true(m.found && !m.creeps && std::abs(m.t - 5) <= tolerance);
  assert_true(m.asked < 50);
  // Long, at the pace of the distance.
  const March far = march(1e9, 1000, [](Vec3) { return 0.25; });
  assert_true(!far.found && !far.creeps);
  assert_in_range(far.asked, 4000, 4002);
}

void test_creeps_no_more_than_thousands_of_steps(void**) {
  // Beside a surface at 1e-9, as long as a few cells.
  const March beside = march(1e9, 4, [](Vec3) { return 1e-9; });
  assert_true(!beside.found && beside.creeps);
  assert_true(beside.asked < 30000);
  // And what comes behind it is found to the tolerance.
  const March behind = march(3, 4, [](Vec3) { return 1e-9; });
  assert_true(behind.found && std::abs(behind.t - 3) <= tolerance);
}

/// Parts of a solid that end `length` after they begin and lie `gap` apart, met along [0, 1].
int count_parts(double length, double gap, double slow) {
  PartSteps steps;
  int parts = 0;
  double at = 0;
  while (at < 1) {
    const double from = std::ceil(at / (length + gap)) * (length + gap), end = from + length;
    at = end + steps.behind(end, tolerance, slow);
    ++parts;
  }
  return parts;
}

void test_parts_that_are_noise_are_left_behind(void**) {
  constexpr double slow = 0x1p18 * tolerance;
  // Parts as short as rounding, and longer ones, as long as 64 of them are within `slow`.
  for (const double length : {0x1p-52, tolerance, 8 * tolerance, 1000 * tolerance})
    assert_in_range(count_parts(length, length, slow), 64, 64 * 37);
  // None of those of a structure is.
  constexpr double cell = 1.0 / 4096;
  assert_in_range(count_parts(cell / 16, cell / 16, 0.25 * cell), 8 * 4096, 8 * 4096 + 1);
}

/// March::asked: by any of the rays.
std::vector<March> march_together(const std::vector<double>& surfaces, double to,
                                  double distance_bound) {
  std::vector<RaySearch> searches;
  for (size_t i = 0; i < surfaces.size(); ++i) searches.push_back({ray, 0, to});
  std::vector<March> marches(surfaces.size());
  msq::march_together(
      searches.data(), searches.size(), tolerance, [](const RaySearch&) { return tolerance; },
      nullptr,
      [&](const std::vector<MarchPoint>& points, uint8_t* there, double* steps) {
        for (size_t i = 0; i < points.size(); ++i) {
          ++marches[points[i].search].asked;
          there[i] = points[i].t >= surfaces[points[i].search];
          steps[i] = distance_bound;
        }
      });
  for (size_t i = 0; i < searches.size(); ++i) {
    marches[i].found = searches[i].found;
    marches[i].t = searches[i].t;
  }
  return marches;
}

void test_rays_together_march_as_each_alone(void**) {
  for (const double distance_bound : {0.25, 1e-3, 1e-9}) {
    const std::vector<double> surfaces = {-1, 0, 0.3, 2, 3.9999, 5, 1e9};
    const std::vector<March> together = march_together(surfaces, 4, distance_bound);
    for (size_t i = 0; i < surfaces.size(); ++i) {
      const March alone = march(surfaces[i], 4, [&](Vec3) { return distance_bound; });
      assert_true(together[i].found == alone.found);
      assert_true(together[i].t == alone.t);
      assert_int_equal(together[i].asked, alone.asked);
      assert_true(alone.asked < 30000);
    }
  }
}

/// A steep function of a host: a plate, |y - pi| <= 1 in angles, with a wall at x = 5 to 5.5.
void test_steep_functions_of_hosts_do_not_hang(void**) {
  constexpr double slope = 1e6, off = 1e-7;
  size_t asked = 0;
  HostFunctionCalls calls;
  calls.evaluate = [&](const Vec3* angles, size_t count, double* values) {
    asked += count;
    for (size_t i = 0; i < count; ++i)
      values[i] =
          slope * std::min(std::abs(angles[i].y - pi) - 1, std::abs(angles[i].x - 5.25) - 0.25);
  };
  const HostFunction function({}, calls, false, Parameter(0.0), 1, slope, true);
  // All but along the plate, beside it and in it.
  const Ray beside{{0.01, (pi + 1 + off) / (2 * pi), 0.5}, {1, 0, 0}};
  RaySearch searches[2] = {{beside, 0, 0.9}, {beside, 0, 0.7}};
  function.enter(searches, 2, nullptr);
  assert_true(searches[0].found && std::abs(searches[0].t + 0.01 - 5 / (2 * pi)) < 1e-9);
  assert_false(searches[1].found);
  assert_true(asked < 60000);
  asked = 0;
  const Ray within{{0.01, (pi + 1 - off) / (2 * pi), 0.5}, {1, 0, 0}};
  assert_true(function.leave(within, 0, 0.9, nullptr) > 0);
  assert_true(asked < 60000);
}

/// A function of a host of slope 1 in angles, at most what its bound says: a plate of 2e-5 angles,
/// about x = pi.
HostFunction plate(bool is_solid) {
  constexpr double half = 1e-5;
  HostFunctionCalls calls;
  calls.evaluate = [=](const Vec3* angles, size_t count, double* values) {
    for (size_t i = 0; i < count; ++i) {
      const double away = std::abs(angles[i].x - pi) - half;
      values[i] = is_solid ? away : -away;
    }
  };
  return HostFunction({}, calls, false, Parameter(0.0), 1, 1, true);
}

void test_functions_of_hosts_lose_no_plates(void**) {
  const HostFunction solid = plate(true), gap = plate(false);
  test::Random random(5);
  std::vector<RaySearch> searches;
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random.in_box({{0, 0, 0}, {0.49, 1, 1}});
    const Vec3 b = random.in_box({{0.51, 0, 0}, {1, 1, 1}});
    const double way = length(b - a);
    searches.push_back({{a, (b - a) * (1 / way)}, 0, way});
  }
  solid.enter(searches.data(), searches.size(), nullptr);
  for (const RaySearch& s : searches) {
    assert_true(s.found && std::abs(s.ray.at(s.t).x - 0.5) < 2e-6);
    const double until = gap.leave(s.ray, 0, s.to, nullptr);
    assert_true(s.ray.at(until).x < 0.5);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_steps_by_the_distance),
      cmocka_unit_test(test_creeps_no_more_than_thousands_of_steps),
      cmocka_unit_test(test_parts_that_are_noise_are_left_behind),
      cmocka_unit_test(test_rays_together_march_as_each_alone),
      cmocka_unit_test(test_steep_functions_of_hosts_do_not_hang),
      cmocka_unit_test(test_functions_of_hosts_lose_no_plates),
  };
  return cmocka_run_group_tests_name("ray_march", tests, nullptr, nullptr);
}
