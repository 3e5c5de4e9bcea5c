/* SPDX-License-Identifier: Apache-2.0
 * msq_field_map. */
#include "fields.h"

static msq_field* make_ramp(msq_context* context) {
  const double from[3] = {0, 0, 0}, to[3] = {10, 0, 0};
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, 0, to, 10, &field));
  return field;
}

static void curve_runs_over_the_other_field(void** state) {
  const double curve[] = {1, 5, 2, 7, 4, -1};
  msq_context* context = make_context();
  msq_field *ramp = make_ramp(context), *field;
  (void)state;
  assert_ok(msq_field_map(context, ramp, curve, 3, &field));
  msq_field_release(ramp); /* the map keeps it */
  assert_near(field_at(context, field, 0, 0, 0), 5, 1e-6);
  assert_near(field_at(context, field, 1.5, 8, 0), 6, 1e-6);
  assert_near(field_at(context, field, 3, 0, 1), 3, 1e-6);
  assert_near(field_at(context, field, 9, 0, 0), -1, 1e-6);
  msq_field_release(field);
  msq_context_release(context);
}

/* A range is that of the values that occur, not that of the curve. */
static void a_radius_may_be_mapped_from_what_no_radius_could_be(void** state) {
  const double curve[] = {-5, -1, 0, 0.1, 10, 0.3};
  msq_context* context = make_context();
  msq_field *ramp = make_ramp(context), *field;
  msq_lattice_def def;
  msq_structure* structure;
  (void)state;
  assert_ok(msq_field_map(context, ramp, curve, 3, &field));
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.field = field;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  msq_structure_release(structure);
  msq_field_release(field);
  msq_field_release(ramp);
  msq_context_release(context);
}

static void at_most_64_maps_are_within_each_other(void** state) {
  const double curve[] = {0, 0, 10, 10};
  msq_context* context = make_context();
  msq_field *last = make_ramp(context), *next;
  (void)state;
  for (int i = 0; i < 64; ++i) {
    assert_ok(msq_field_map(context, last, curve, 2, &next));
    msq_field_release(last);
    last = next;
  }
  assert_near(field_at(context, last, 3, 0, 0), 3, 1e-6);
  assert_makes_nothing(msq_field, msq_field_map(context, last, curve, 2, &made), MSQ_E_LIMIT, "65");
  msq_field_release(last);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(curve_runs_over_the_other_field),
      cmocka_unit_test(a_radius_may_be_mapped_from_what_no_radius_could_be),
      cmocka_unit_test(at_most_64_maps_are_within_each_other),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
