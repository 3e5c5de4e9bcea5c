/* SPDX-License-Identifier: Apache-2.0
 * msq_expression_field_def_init, msq_field_expression. */
#include "fields.h"

static msq_expression_field_def expression_def(const char* text) {
  msq_expression_field_def def;
  assert_ok(msq_expression_field_def_init(&def, sizeof def));
  def.expression = text;
  def.high = 100;
  return def;
}

static void field_is_the_expression_within_its_range(void** state) {
  const msq_named_value parameters[] = {{"slope", 2}, {"offset", 7}};
  msq_context* context = make_context();
  msq_expression_field_def def = expression_def("slope*x + offset - y*z");
  msq_field* field;
  (void)state;
  def.parameters = parameters;
  def.parameter_count = 2;
  assert_ok(msq_field_expression(context, &def, &field));
  assert_near(field_at(context, field, 1, 0, 0), 9, 1e-6);
  assert_near(field_at(context, field, 1, 2, 3), 3, 1e-6);
  assert_near(field_at(context, field, 90, 0, 3), 100, 1e-6);
  assert_near(field_at(context, field, -90, 0, 3), 0, 1e-6);
  msq_field_release(field);
  def = expression_def("sqrt(x)");
  def.low = -3;
  assert_ok(msq_field_expression(context, &def, &field));
  assert_near(field_at(context, field, 4, 0, 0), 2, 1e-6);
  assert_near(field_at(context, field, -4, 0, 0), -3, 1e-6); /* no number */
  msq_field_release(field);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(field_is_the_expression_within_its_range),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
