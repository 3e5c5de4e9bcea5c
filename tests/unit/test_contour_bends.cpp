// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_bends.h"

#include <cmath>
#include <vector>

#include "base/vec2.h"
#include "random.h"
#include "suite.h"

namespace msq::test {

namespace {

/// The fast test for bends against its definition.
void test_bends(void**) {
  Random random(31);
  const double tolerance = 0.05, close = 0.02;
  for (const size_t count : {size_t{3}, size_t{64}, size_t{130}, size_t{1000}}) {
    std::vector<double> x(count), y(count);
    double angle = 0;
    for (size_t i = 1; i < count; ++i) {
      angle += random.between(-0.6, 0.7);
      const double step = random.between(0, 1) < 0.1 ? random.between(0, 0.03) : 0.3;
      x[i] = x[i - 1] + step * std::cos(angle);
      y[i] = y[i - 1] + step * std::sin(angle);
    }
    std::vector<uint64_t> bits((count + 63) / 64);
    find_bends(x.data(), y.data(), count, tolerance, close, bits.data());
    size_t found = 0, flat = 0;
    for (size_t i = 1; i + 2 < count; ++i) {
      const auto at = [&](size_t n) { return Vec2{x[n], y[n]}; };
      const Vec2 d1 = at(i) - at(i - 1), ab = at(i + 1) - at(i), d2 = at(i + 2) - at(i + 1);
      const double turn1 = cross(d1, ab), turn2 = cross(ab, d2), turn = cross(d1, d2);
      bool bends = length(ab) > tolerance;
      if (length(d1) >= close && length(d2) >= close) {
        if (turn1 * turn2 <= 0)
          bends = bends && std::max(std::abs(turn1) / length(d1), std::abs(turn2) / length(d2)) >
                               2 * tolerance;
        else
          bends = bends &&
                  !(turn * turn1 > 0 && std::abs(turn1 * turn2 / turn) <= tolerance * length(ab));
      }
      const bool is_found = bits[i / 64] >> (i % 64) & 1;
      // Near both ends of the points, words are not looked at.
      const bool may_differ = i < 64 || i / 64 * 64 + 66 > count;
      if (is_found != bends && !(may_differ && is_found)) fail_msg("piece %zu of %zu", i, count);
      found += bends;
      flat += !is_found;
    }
    if (count == 1000) assert_true(found > 50 && flat > 50);
  }
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  const CMUnitTest tests[] = {cmocka_unit_test(test_bends)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
