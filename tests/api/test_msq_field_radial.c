/* SPDX-License-Identifier: Apache-2.0
 * msq_radial_field_def_init, msq_field_radial. */
#include "fields.h"

static msq_radial_field_def radial_def(void) {
  msq_radial_field_def def;
  assert_ok(msq_radial_field_def_init(&def, sizeof def));
  def.center[0] = 1;
  def.from_radius = 1;
  def.from_value = 10;
  def.to_radius = 3;
  def.to_value = 20;
  return def;
}

static void field_runs_with_the_distance_from_a_point(void** state) {
  msq_context* context = make_context();
  const msq_radial_field_def def = radial_def();
  msq_field* field;
  (void)state;
  assert_ok(msq_field_radial(context, &def, &field));
  assert_near(field_at(context, field, 1, 0, 0), 10, 1e-6);
  assert_near(field_at(context, field, 1, 2, 0), 15, 1e-6);
  assert_near(field_at(context, field, 1, 0, -2), 15, 1e-6);
  assert_near(field_at(context, field, -9, 0, 0), 20, 1e-6);
  msq_field_release(field);
  msq_context_release(context);
}

static void field_runs_with_the_distance_from_a_line(void** state) {
  msq_context* context = make_context();
  msq_radial_field_def def = radial_def();
  msq_field* field;
  (void)state;
  def.axis[2] = 0.01;
  assert_ok(msq_field_radial(context, &def, &field));
  assert_near(field_at(context, field, 1, 0, 50), 10, 1e-6);
  assert_near(field_at(context, field, 1, 2, -50), 15, 1e-6);
  assert_near(field_at(context, field, 9, 0, 7), 20, 1e-6);
  msq_field_release(field);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(field_runs_with_the_distance_from_a_point),
      cmocka_unit_test(field_runs_with_the_distance_from_a_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
