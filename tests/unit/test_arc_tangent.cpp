// SPDX-License-Identifier: Apache-2.0
// The arc tangent against the C library's in extended precision, and its signs of zeros.
#include "base/arc_tangent.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_error(void**) {
  Random random(1);
  double greatest = 0;
  for (size_t i = 0; i < test_count(2000000); ++i) {
    const double angle = random.between(-4, 4), size = std::pow(2.0, random.between(-300, 300));
    double x = size * std::cos(angle), y = size * std::sin(angle);
    if (i % 4 == 1) y *= std::pow(2.0, random.between(-200, 0));
    if (i % 4 == 2) x *= std::pow(2.0, random.between(-200, 0));
    if (i % 4 == 3) y = x * (static_cast<double>(random.below(16)) + 0.5) / 16;
    const long double wanted = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    greatest = std::max(greatest, static_cast<double>(std::abs(arc_tangent(y, x) - wanted)));
  }
  if (!(greatest < 0x1p-50)) fail_msg("an error of %g", greatest);
}

void test_zeros(void**) {
  const double values[] = {0.0, -0.0, 1.0, -1.0};
  for (double y : values)
    for (double x : values) {
      const double wanted = std::atan2(y, x), got = arc_tangent(y, x);
      assert_true(std::abs(got - wanted) < 1e-15 && std::signbit(got) == std::signbit(wanted));
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_error), cmocka_unit_test(test_zeros)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
