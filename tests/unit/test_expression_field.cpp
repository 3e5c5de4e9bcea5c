// SPDX-License-Identifier: Apache-2.0
// Fields that are expressions: their values, and what they know of them over boxes.
#include "field/expression.h"

#include "expression/parser.h"
#include "field_checks.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_values(void**) {
  const ExpressionField field(parse_expression("a*x + sqrt(y) - z", {{"a", 3}}), {-5, 10});
  assert_true(field.at({1, 4, 2}) == 3);
  assert_true(field.at({100, 4, 2}) == 10);
  assert_true(field.at({1, 4, 200}) == -5);
  assert_true(field.at({1, -4, 2}) == -5);  // no number
  assert_true(field.range().low == -5 && field.range().high == 10);
}

/// No number is the least value, and ranges hold that, in either order.
void test_what_is_no_number(void**) {
  for (const char* text : {"max(sqrt(x), 1)", "max(1, sqrt(x))", "min(1, log(x))+2",
                           "min(log(x), 1)+2", "abs(max(x^0.5, 1))"}) {
    const ExpressionField field(parse_expression(text, {}), {-5, 10});
    assert_true(field.at({-1, 0, 0}) == -5 && field.at({4, 0, 0}) >= 1);
    const Interval range = field.range({{-1, 0, 0}, {1, 1, 1}});
    assert_true(range.low == -5);
    assert_true(field.lipschitz({{-1, 0, 0}, {1, 1, 1}}) ==
                std::numeric_limits<double>::infinity());
  }
}

void test_promises(void**) {
  const char* const texts[] = {"x + 2*y - z",
                               "sin(x)*cos(3*y) + exp(-z*z)",
                               "sqrt(x*x + y*y)/ (1 + z^2)",
                               "max(min(x, y), log(z))",
                               "1/x",
                               "0.5",
                               "(x^2+y^2)^0.25 - abs(z)"};
  Random random(14);
  size_t linear = 0, bounded = 0;
  for (const char* text : texts) {
    const ExpressionField field(parse_expression(text, {}), {-1.5, 2});
    const FieldOutcome near =
        check_field(field, Box3{}.grown(3), 1e-6, 4, test_count(2000), random);
    linear += near.linear;
    bounded += near.bounded;
    linear += check_field(field, Box3{}.grown(1e6), 1e-3, 4, test_count(500), random).linear;
  }
  assert_true(linear > 0);
  assert_true(bounded > test_count(2000) * 7 / 2);
}

void test_ranges_are_tight(void**) {
  const ExpressionField field(parse_expression("x*y + sin(z)", {}), {-1e6, 1e6});
  const Interval range = field.range({{1, 2, 0.1}, {1.1, 2.2, 0.2}});
  assert_true(range.low > 2 + 0.09 && range.high < 2.42 + 0.2);
  const Interval cut =
      ExpressionField(parse_expression("x", {}), {0, 1}).range({{-3, 0, 0}, {9, 0, 0}});
  assert_true(cut.low == 0 && cut.high == 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_values), cmocka_unit_test(test_what_is_no_number),
      cmocka_unit_test(test_promises), cmocka_unit_test(test_ranges_are_tight)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
