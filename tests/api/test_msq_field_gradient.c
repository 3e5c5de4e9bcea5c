/* SPDX-License-Identifier: Apache-2.0
 * msq_field_gradient, msq_field_retain, msq_field_release. */
#include "fixtures.h"

static const double from[3] = {1, 0, 0}, to[3] = {3, 0, 0};

static msq_field* make_field(msq_context* context, double from_value, double to_value) {
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, from_value, to, to_value, &field));
  return field;
}

/* Takes over one reference of the field. */
static msq_structure* make_graded_lattice(msq_context* context, msq_field* field) {
  msq_lattice_def def;
  msq_structure* structure;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  def.radius.value = NAN; /* where there is a field, the value is nothing */
  def.radius.field = field;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  msq_field_release(field);
  return structure;
}

/* The struts along x, at the middle of a cell, where no other is near, have the field for radius.
 */
static void field_runs_linearly_and_is_constant_beyond(void** state) {
  const double x[] = {0.5, 1.5, 2.5, 3.5}, radius[] = {0.1, 0.15, 0.25, 0.3};
  msq_context* context = make_context();
  msq_structure* lattice = make_graded_lattice(context, make_field(context, 0.1, 0.3));
  msq_model* model = make_model(context, make_box_of(context, -1, 5), lattice, NULL);
  (void)state;
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(is_inside(model, x[i], 2 + radius[i] - 1e-9, 2), 1);
    assert_int_equal(is_inside(model, x[i], 2 + radius[i] + 1e-9, 2), 0);
    assert_int_equal(is_inside(model, x[i], 2, 2 - radius[i] + 1e-9), 1);
    assert_int_equal(is_inside(model, x[i], 2, 2 - radius[i] - 1e-9), 0);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void field_may_fall_and_be_0_on_a_side(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_graded_lattice(context, make_field(context, 0.3, 0));
  msq_model* model = make_model(context, make_box_of(context, -1, 5), lattice, NULL);
  (void)state;
  assert_int_equal(is_inside(model, 0.5, 2.29, 2), 1);
  assert_int_equal(is_inside(model, 1.5, 2.224, 2), 1);
  assert_int_equal(is_inside(model, 1.5, 2.226, 2), 0);
  assert_int_equal(is_inside(model, 3.5, 2.001, 2), 0);
  msq_model_release(model);
  msq_context_release(context);
}

static void one_field_serves_many_structures(void** state) {
  msq_context* context = make_context();
  msq_field* field = make_field(context, 0.1, 0.3);
  (void)state;
  msq_field_retain(field);
  msq_structure* first = make_graded_lattice(context, field);
  msq_structure* second = make_graded_lattice(context, field);
  msq_structure_release(first);
  msq_model* model = make_model(context, make_box(context), second, NULL);
  msq_context_release(context);
  assert_int_equal(is_inside(model, 2.5, 2.24, 2), 1);
  msq_model_release(model);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_field_release(NULL);
  msq_field_retain(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(field_runs_linearly_and_is_constant_beyond),
      cmocka_unit_test(field_may_fall_and_be_0_on_a_side),
      cmocka_unit_test(one_field_serves_many_structures),
      cmocka_unit_test(release_of_null_does_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
