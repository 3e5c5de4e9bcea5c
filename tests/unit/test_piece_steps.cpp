// SPDX-License-Identifier: Apache-2.0
// Steps along pieces of rays: the gap to the level stays open up to them and closes at them, for
// numbers of any magnitude; nothing is proven where bounds are not finite.
#include "structure/functional/piece_steps.h"

#include <cmath>
#include <limits>

#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr size_t lanes = PieceSteps::lanes;

/// Values of bounds, by lane.
struct Arrays {
  double value[lanes] = {}, low[lanes] = {}, high[lanes] = {}, bend[lanes] = {}, error[lanes] = {};
  RayBatch::Bounds bounds() const { return {value, low, high, bend, error}; }
};

struct Row {
  std::string name;
  bool wanted;
  double exponent;  ///< numbers are up to 2 to that, and down to its inverse
};

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(5);
  const auto number = [&] { return std::exp2(random.between(-row.exponent, row.exponent)); };
  const auto any = [&] { return (random.below(2) ? 1 : -1) * number(); };
  size_t closed = 0, open = 0, none = 0, opening = 0;
  for (size_t n = 0; n < test_count(500); ++n) {
    Arrays arrays;
    PieceLevels levels;
    PieceSteps steps;
    const double cell = n % 3 == 0 ? 1 : std::exp2(random.between(-10, 10));
    const size_t count = 1 + random.below(lanes);
    for (size_t i = 0; i < count; ++i) {
      arrays.value[i] = any();
      arrays.low[i] = any();
      arrays.high[i] = arrays.low[i];
      arrays.bend[i] = i % 4 == 0 ? 0 : number();
      arrays.error[i] = i % 3 == 0 ? 0 : 1e-9 * number();
      levels.value[i] = i % 5 == 0 ? 0 : any();
      levels.low[i] = i % 2 ? 0 : -1e-3 * number();
      levels.high[i] = i % 2 ? 0 : 1e-3 * number();
      levels.above[i] = levels.below[i] = i % 2 ? 0 : 1e-9 * number();
      steps.most[i] = cell * number();
    }
    steps.find(row.wanted, arrays.bounds(), levels, cell, count);
    for (size_t i = 0; i < count; ++i) {
      const double sign = row.wanted ? 1 : -1;
      const double gap = sign * (arrays.value[i] - levels.value[i]) - arrays.error[i] -
                         (row.wanted ? levels.above[i] : levels.below[i]);
      const double slope = row.wanted ? arrays.low[i] - levels.high[i] * cell
                                      : levels.low[i] * cell - arrays.high[i];
      assert_true(steps.gap[i] == gap);
      assert_true(steps.slope[i] == slope);
      const double step = steps.step[i];
      if (!(gap > 0)) {
        ++none;
        assert_true(step == 0);
        continue;
      }
      // Relative to the gap.
      const auto left = [&](long double s) {
        const long double t = s / cell;
        return 1 + slope * t / gap - arrays.bend[i] * t * t / gap;
      };
      const long double rounding =
          1e-9L * (1 + std::abs(slope * static_cast<long double>(step) / cell / gap));
      assert_true(step > 0 && step <= steps.most[i] * (1 + 1e-15));
      assert_true(left(step * (1 - 1e-11L)) > -rounding);
      // Where the gap opens first and is far below what it reaches, the step may be short.
      if (slope > 0 && slope * slope > 0x1p10L * arrays.bend[i] * gap) {
        ++opening;
        continue;
      }
      const bool is_all = step >= steps.most[i] * (1 - 1e-15);
      ++(is_all ? open : closed);
      if (!is_all) assert_true(left(step * (1 + 1e-11L)) < rounding);
    }
  }
  if (test_count(500) < 20) return;
  assert_true(none > 10);
  assert_true(closed > 10);
  assert_true(open > 10);
  assert_true(opening > 10);
}

void proves_nothing_without_bounds(void**) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = NAN;
  for (const bool wanted : {true, false}) {
    Arrays arrays;
    PieceLevels levels;
    PieceSteps steps;
    for (size_t i = 0; i < lanes; ++i) {
      arrays.value[i] = wanted ? 1 : -1;
      steps.most[i] = 1;
    }
    arrays.value[0] = nan;
    arrays.bend[1] = infinity;
    arrays.bend[2] = nan;
    arrays.low[3] = arrays.high[3] = nan;
    arrays.low[4] = -infinity;
    arrays.high[4] = infinity;
    arrays.error[5] = nan;
    levels.value[6] = nan;
    arrays.value[7] = wanted ? infinity : -infinity;
    steps.find(wanted, arrays.bounds(), levels, 1, lanes);
    for (size_t i = 0; i < 7; ++i) assert_true(steps.step[i] == 0);
    for (size_t i = 7; i < lanes; ++i) assert_true(steps.step[i] == 1);
  }
}

}  // namespace

int main() {
  std::vector<Row> rows = {{"entries", true, 10},
                           {"exits", false, 10},
                           {"entries, any magnitude", true, 500},
                           {"exits, any magnitude", false, 500}};
  const CMUnitTest tests[] = {cmocka_unit_test(proves_nothing_without_bounds)};
  const int failed = cmocka_run_group_tests_name("piece_steps", tests, nullptr, nullptr);
  return failed + run_for_each("piece_steps", rows, test_row);
}
