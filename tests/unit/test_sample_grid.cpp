// SPDX-License-Identifier: Apache-2.0
// set_bits and first_sample_from, in all small cases, against loops.
#include <vector>

#include "base/sample_grid.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_set_bits(void**) {
  constexpr uint64_t bits = 200;  // four words, the last one partly used
  for (uint64_t first = 0; first < bits; ++first)
    for (uint64_t last = first; last < bits; ++last)
      for (uint64_t background : {uint64_t{0}, uint64_t{0x8000000000000001}}) {
        uint64_t row[4] = {background, background, background, background};
        set_bits(row, first, last);
        for (uint64_t i = 0; i < 256; ++i) {
          const bool wanted = (i >= first && i <= last) || (background >> (i % 64) & 1);
          if ((row[i / 64] >> (i % 64) & 1) != wanted)
            fail_msg("bits %d to %d: bit %d is wrong", int(first), int(last), int(i));
        }
      }
}

uint64_t first_by_loop(double origin, double spacing, uint64_t count, double value, bool beyond) {
  for (uint64_t i = 0; i < count; ++i) {
    const double x = origin + static_cast<double>(i) * spacing;
    if (beyond ? x > value : x >= value) return i;
  }
  return count;
}

void check_first(double origin, double spacing, uint64_t count, double value) {
  const uint64_t from = first_sample_from(origin, spacing, count, value);
  const uint64_t beyond = first_sample_from<true>(origin, spacing, count, value);
  if (from != first_by_loop(origin, spacing, count, value, false) ||
      beyond != first_by_loop(origin, spacing, count, value, true))
    fail_msg("origin %.17g, spacing %.17g, count %d, value %.17g: %d and %d", origin, spacing,
             int(count), value, int(from), int(beyond));
}

void test_first_sample(void**) {
  for (double origin : {-1.0, -0.3, 0.0, 0.1, 1000.7, -1e6, 1e15})
    for (double spacing : {1.0, 0.1, 1.0 / 3, 0.125, 1e-3})
      for (uint64_t count : {1, 2, 7}) {
        for (int i = -3; i < static_cast<int>(count) + 3; ++i)
          for (double part : {0.0, 0.25, 0.5}) {
            const double at = origin + (i + part) * spacing;
            check_first(origin, spacing, count, at);
            check_first(origin, spacing, count, std::nextafter(at, -1e300));
            check_first(origin, spacing, count, std::nextafter(at, 1e300));
          }
        for (double value : {-1e300, 1e300}) check_first(origin, spacing, count, value);
      }
  Random random(1);
  for (size_t n = test_count(200000); n > 0; --n) {
    const double origin = random.between(-10, 10), spacing = random.between(1e-3, 2);
    const uint64_t count = 1 + random.below(30);
    const double at = origin + static_cast<double>(random.below(count + 2)) * spacing;
    check_first(origin, spacing, count, n % 2 ? at : random.between(-20, 70));
  }
}

void test_words(void**) {
  assert_int_equal(words_for(1), 1);
  assert_int_equal(words_for(64), 1);
  assert_int_equal(words_for(65), 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_set_bits), cmocka_unit_test(test_first_sample),
                              cmocka_unit_test(test_words)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
