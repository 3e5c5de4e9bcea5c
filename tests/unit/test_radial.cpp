// SPDX-License-Identifier: Apache-2.0
// The field that runs with the distance from a point or a line.
#include "field/radial.h"
#include "field_checks.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_values_about_a_point(void**) {
  const RadialField field({1, 2, 3}, {}, {1, 5, 3, -3});
  assert_true(field.at({1, 2, 3}) == 5);
  assert_true(field.at({1, 2, 4}) == 5);
  assert_true(field.at({1, 4, 3}) == 1);
  assert_true(field.at({-2, 2, 3}) == -3);
  assert_true(field.at({90, 2, 3}) == -3);
  assert_true(field.range().low == -3 && field.range().high == 5);
  assert_true(std::abs(field.lipschitz() - 4) < 1e-12);
}

void test_values_about_a_line(void**) {
  // The length of the axis is nothing.
  for (double length : {1e-200, 0.1, 1e200}) {
    const RadialField field({1, 2, 3}, {0, length, 0}, {0, 0, 2, 1});
    assert_true(field.at({1, 77, 3}) == 0);
    assert_true(field.at({2, -9, 3}) == 0.5);
    assert_true(field.at({1, 0, 6}) == 1);
  }
}

void test_promises(void**) {
  Random random(3);
  size_t linear = 0, boxes = 0;
  for (int n = 0; n < static_cast<int>(test_count(400)); ++n) {
    const double far = n % 3 ? 1 : 1e6;
    const Vec3 centre = random.in_box(Box3{}.grown(far));
    Vec3 axis = random.in_box(Box3{}.grown(1));
    if (n % 2) axis = {};
    if (n % 4 == 2) axis = {0, 0, 1};
    const double from = n % 5 ? random.unit() : 0;
    const RadialField field(centre, axis,
                            {from, random.between(-1, 1),
                             from + std::pow(10, random.between(-4, 1)), random.between(-1, 1)});
    const FieldOutcome outcome =
        check_field(field, Box3{centre, centre}.grown(3), 1e-6, 4, 100, random);
    linear += outcome.linear;
    boxes += outcome.boxes;
  }
  assert_true(linear > boxes / 20);
}

/// A small box knows the field almost as its corners do.
void test_ranges_are_tight(void**) {
  const RadialField ball({0, 0, 0}, {}, {0, 0, 10, 10}), line({0, 0, 0}, {0, 0, 1}, {0, 0, 10, 10});
  const Box3 box{{3, 4, -1}, {3.03, 4.04, 0}};
  assert_true(line.range(box).low > 4.99 && line.range(box).low <= 5);
  assert_true(line.range(box).high < 5.06 && line.range(box).high >= 5.05);
  assert_true(ball.range(box).low <= 5 && ball.range(box).low > 5 - 1e-12);
  const double most = std::sqrt(3.03 * 3.03 + 4.04 * 4.04 + 1);
  assert_true(ball.range(box).high >= most && ball.range(box).high < most + 1e-12);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_values_about_a_point), cmocka_unit_test(test_values_about_a_line),
      cmocka_unit_test(test_promises), cmocka_unit_test(test_ranges_are_tight)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
