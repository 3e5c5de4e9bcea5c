/* SPDX-License-Identifier: Apache-2.0
 * msq_expression_field_def_init, msq_field_expression. */
#include "fields.h"

DEFINE_INIT(expression_field_def)

static msq_expression_field_def expression_def(const char* text) {
  msq_expression_field_def def;
  assert_ok(msq_expression_field_def_init(&def, sizeof def));
  def.expression = text;
  def.high = 100;
  return def;
}

DEFINE_CREATE(field, field_expression, expression_field_def)

static void def_init_honours_every_size(void** state) {
  (void)state;
  check_def_init(init_expression_field_def, sizeof(msq_expression_field_def));
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  const msq_expression_field_def def = expression_def("x");
  (void)state;
  check_def_sizes(&def, sizeof def, create, context);
  msq_context_release(context);
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

static void bad_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  msq_expression_field_def def = expression_def("x");
  (void)state;
  assert_makes_nothing(msq_field, msq_field_expression(NULL, &def, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_field, msq_field_expression(context, NULL, &made), MSQ_E_ARGUMENT,
                       "def is NULL");
  assert_refused(msq_field_expression(context, &def, NULL), MSQ_E_ARGUMENT, "field is NULL");
  def.reserved = 3;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "reserved is 3");
  def = expression_def(NULL);
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "expression is NULL");
  def = expression_def("x + ");
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "character 5");
  def = expression_def("x");
  def.parameter_count = 1;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "parameters is NULL");
  for (int which = 0; which < 3; ++which) {
    def = expression_def("x");
    def.low = not_finite(which);
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "low");
    def = expression_def("x");
    def.high = not_finite(which);
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "high");
  }
  def = expression_def("x");
  def.low = 101;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "low is 101 and high is 100");
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(def_init_honours_every_size),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(field_is_the_expression_within_its_range),
      cmocka_unit_test(bad_arguments_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
