// SPDX-License-Identifier: Apache-2.0
// A piecewise linear curve, alone and over another field.
#include "field/map.h"

#include <limits>

#include "field/gradient.h"
#include "field_checks.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

void test_curve(void**) {
  const Curve curve({{-1, 4}, {0, 2}, {2, 3}, {3, -1}});
  assert_true(curve(-inf) == 4 && curve(-1) == 4 && curve(0) == 2 && curve(1) == 2.5);
  assert_true(curve(2) == 3 && curve(2.5) == 1 && curve(3) == -1 && curve(inf) == -1);
  const Interval all = curve.range({-inf, inf}), part = curve.range({-0.5, 2.5});
  assert_true(all.low == -1 && all.high == 4);
  assert_true(part.low == 1 && part.high == 3);
  const Interval on_knots = curve.range({0, 2}), beyond = curve.range({7, 9});
  assert_true(on_knots.low == 2 && on_knots.high == 3);
  assert_true(beyond.low == -1 && beyond.high == -1);
  assert_true(std::abs(curve.lipschitz() - 4) < 1e-12);
}

void test_curve_of_one_knot(void**) {
  const Curve curve({{7, 3}});
  assert_true(curve(-inf) == 3 && curve(7) == 3 && curve(8) == 3);
  assert_true(curve.range({-inf, inf}).low == 3 && curve.range({-inf, inf}).high == 3);
  assert_true(curve.lipschitz() == 0);
}

void test_curve_runs_one_way_between_knots(void**) {
  Random random(5);
  for (int n = 0; n < static_cast<int>(test_count(20000)); ++n) {
    const double a = random.between(-1, 1), b = a + std::pow(10, random.between(-12, 3));
    const Curve curve({{a, random.between(-1, 1)}, {b, random.between(-1, 1) * (n % 2 ? 1 : 1e9)}});
    const double v = random.between(a, b), w = std::nextafter(v, inf);
    const double way = curve(b) - curve(a), step = curve(w) - curve(v);
    assert_true(way > 0 ? step >= 0 : step <= 0);
    const Interval range = curve.range({v, w});
    assert_true(range.low == std::min(curve(v), curve(w)));
    assert_true(range.high == std::max(curve(v), curve(w)));
  }
}

void test_promises(void**) {
  Random random(4);
  size_t linear = 0, boxes = 0;
  for (int n = 0; n < static_cast<int>(test_count(300)); ++n) {
    const Vec3 from = random.in_box(Box3{}.grown(2)), to = random.in_box(Box3{}.grown(2));
    const auto ramp =
        make_ref<GradientField>(from, random.between(-3, 3), to, random.between(-3, 3));
    std::vector<Curve::Knot> knots;
    double at = -2;
    for (uint64_t i = 0, count = 1 + random.below(9); i < count; ++i)
      knots.push_back(
          {at += random.unit(), i % 4 == 3 ? knots.back().value : random.between(-1, 1)});
    const MapField field(ramp, Curve(knots));
    const FieldOutcome outcome = check_field(field, Box3{}.grown(3), 1e-6, 4, 100, random);
    linear += outcome.linear;
    boxes += outcome.boxes;
  }
  assert_true(linear > boxes / 20);
}

void test_slope_where_the_argument_is_constant(void**) {
  const auto same = make_ref<GradientField>(Vec3{}, 0.5, Vec3{1, 0, 0}, 0.5);
  const MapField field(same, Curve({{0, 1}, {1e-320, 2}}));  // as steep as can be
  assert_true(field.lipschitz() == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_curve), cmocka_unit_test(test_curve_of_one_knot),
      cmocka_unit_test(test_curve_runs_one_way_between_knots), cmocka_unit_test(test_promises),
      cmocka_unit_test(test_slope_where_the_argument_is_constant)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
