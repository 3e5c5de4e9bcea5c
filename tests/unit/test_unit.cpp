// SPDX-License-Identifier: Apache-2.0
// Directions of vectors whose squares vanish, or overflow.
#include "base/unit.h"

#include <limits>

#include "suite.h"

using namespace msq;

namespace {

void test_every_length(void**) {
  for (int power = -1070; power <= 1020; ++power) {
    const double size = std::ldexp(1.0, power);
    const Vec3 unit = unit_along({2 * size, -3 * size, 6 * size});
    // Of the smallest numbers two bits are left, and more of larger ones.
    const double error = std::max(0x1p-50, std::ldexp(1.0, -1073 - power));
    assert_true(std::abs(length(unit) - 1) < 0x1p-50);
    assert_true(length(unit - Vec3{2.0 / 7, -3.0 / 7, 6.0 / 7}) <= error);
  }
}

void test_no_direction(void**) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  assert_true(unit_along({0, 0, 0}) == Vec3{});
  assert_true(unit_along({infinite, 0, 0}) == Vec3{});
  assert_true(unit_along({0, std::numeric_limits<double>::quiet_NaN(), 0}) == Vec3{});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_every_length),
      cmocka_unit_test(test_no_direction),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
