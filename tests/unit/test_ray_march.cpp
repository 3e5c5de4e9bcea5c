// SPDX-License-Identifier: Apache-2.0
// Marches along rays: what they find, and how often they ask where the distance is next to nothing.
#include "base/ray.h"
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
template <class Clearance>
March march(double surface, double to, Clearance&& clearance) {
  March m;
  const auto inside = [&](Vec3 p) {
    ++m.asked;
    return p.x >= surface;
  };
  m.found = RayMarch{tolerance, tolerance}.find(true, ray, 0, to, inside, clearance, m.t,
                                                &m.creeps);
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_steps_by_the_distance),
      cmocka_unit_test(test_creeps_no_more_than_thousands_of_steps),
  };
  return cmocka_run_group_tests_name("ray_march", tests, nullptr, nullptr);
}
