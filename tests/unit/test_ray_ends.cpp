// SPDX-License-Identifier: Apache-2.0
// Ends of rays and of their parts, settled by membership: within the tolerance, and within the ray.
#include <cmath>

#include "random.h"
#include "structure/common/ray_parts.h"
#include "suite.h"

using namespace msq;

namespace {

constexpr double tolerance = 0x1p-30;

/// A region [surface, ...] found too early by up to 1000 tolerances: the part begins at most one
/// tolerance past the surface. The same backwards.
void test_ends_of_parts(void**) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double surface = random.between(-1, 1);
    const double early = surface - tolerance * std::exp2(random.between(-3, 10));
    const double t =
        settle_end(early, surface + 1, tolerance, [&](double s) { return s >= surface; });
    assert_true(t >= surface && t <= surface + tolerance);
    const double back =
        settle_end(-early, -surface - 1, tolerance, [&](double s) { return s <= -surface; });
    assert_true(back == -t);
  }
  const auto nowhere = [](double) { return false; };
  assert_true(settle_end(0, 1, tolerance, nowhere) == infinity);
  assert_true(settle_end(1, 0, tolerance, nowhere) == -infinity);
  const auto everywhere = [](double) { return true; };
  assert_true(settle_end(0.25, 1, tolerance, everywhere) == 0.25);
}

void test_entries_end_with_the_ray(void**) {
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  const double end = 0.5;
  for (const double surface : {end + 0.25 * tolerance, end, end - 0.25 * tolerance}) {
    double t = end - 0.5 * tolerance;
    const bool found = settle_entry(
        ray, 0, end, tolerance, [&](Vec3 p) { return p.x >= surface; }, t);
    assert_true(found == (surface <= end));
    if (found) assert_true(t >= surface && t <= end);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_ends_of_parts),
      cmocka_unit_test(test_entries_end_with_the_ray),
  };
  return cmocka_run_group_tests_name("ray ends", tests, nullptr, nullptr);
}
