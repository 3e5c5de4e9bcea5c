/* SPDX-License-Identifier: Apache-2.0
 * msq_radial_field_def_init, msq_field_radial. */
#include "fields.h"

DEFINE_INIT(radial_field_def)

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

DEFINE_CREATE(field, field_radial, radial_field_def)

static void def_init_honours_every_size(void** state) {
  (void)state;
  check_def_init(init_radial_field_def, sizeof(msq_radial_field_def));
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  const msq_radial_field_def def = radial_def();
  (void)state;
  check_def_sizes(&def, sizeof def, create, context);
  msq_context_release(context);
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

static void null_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  const msq_radial_field_def def = radial_def();
  (void)state;
  assert_makes_nothing(msq_field, msq_field_radial(NULL, &def, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_field, msq_field_radial(context, NULL, &made), MSQ_E_ARGUMENT,
                       "def is NULL");
  assert_refused(msq_field_radial(context, &def, NULL), MSQ_E_ARGUMENT, "field is NULL");
  msq_context_release(context);
}

static void bad_numbers_are_refused(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (int which = 0; which < 3; ++which) {
    const double bad = not_finite(which);
    for (int number = 0; number < 10; ++number) {
      msq_radial_field_def def = radial_def();
      double* const numbers[] = {&def.center[0], &def.center[1], &def.center[2],   &def.axis[0],
                                 &def.axis[1],   &def.axis[2],   &def.from_radius, &def.from_value,
                                 &def.to_radius, &def.to_value};
      *numbers[number] = bad;
      assert_refused(create(context, &def), MSQ_E_ARGUMENT, "finite");
    }
  }
  msq_radial_field_def def = radial_def();
  def.from_radius = -0.25;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "from_radius is -0.25");
  def.from_radius = 3;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "to_radius is 3");
  def = radial_def();
  def.reserved = 7;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "reserved is 7");
  def = radial_def();
  def.from_value = -1e308;
  def.to_value = 1e308;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "difference");
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(def_init_honours_every_size),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(field_runs_with_the_distance_from_a_point),
      cmocka_unit_test(field_runs_with_the_distance_from_a_line),
      cmocka_unit_test(null_arguments_are_refused),
      cmocka_unit_test(bad_numbers_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
