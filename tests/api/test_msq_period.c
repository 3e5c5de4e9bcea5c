/* SPDX-License-Identifier: Apache-2.0
 * msq_period_def_init, and msq_functional_def.period. */
#include "definitions.h"
#include "periods.h"

DEFINE_CREATE(structure, structure_functional, functional_def)

static msq_functional_def functional_def(const msq_period_def* period) {
  msq_functional_def def;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.level.value = 0.25;
  def.period = period;
  return def;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_period_def def;
  (void)state;
  assert_ok(msq_period_def_init(&def, sizeof def));
  assert_int_equal(def.axis, 2);
  assert_null(def.positions);
  assert_null(def.cell_sizes);
  assert_int_equal(def.count, 0);
}

static msq_status create_with(void* env, void* period) {
  msq_functional_def def = functional_def((const msq_period_def*)period);
  return create(env, &def);
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  const msq_period_def period = period_def();
  msq_functional_def def = functional_def(&period);
  msq_period_def other = period;
  (void)state;
  assert_ok(create(context, &def));
  def.period = &other;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t refused[3] = {0, (uint32_t)sizeof other - 1, 4097};
    other.struct_size = refused[i];
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "struct_size of period");
  }
  msq_context_release(context);
}

static void what_makes_no_map_is_refused(void** state) {
  msq_context* context = make_context();
  double s[4], h[4];
  msq_period_def def = period_def();
  (void)state;
#define REFUSED(change, status, text)                         \
  do {                                                        \
    memcpy(s, positions, sizeof s);                           \
    memcpy(h, sizes, sizeof h);                               \
    def = period_def();                                       \
    def.positions = s;                                        \
    def.cell_sizes = h;                                       \
    change;                                                   \
    assert_refused(create_with(context, &def), status, text); \
  } while (0)
  REFUSED(def.axis = -1, MSQ_E_ARGUMENT, "period.axis is -1; it must be from 0 to 2");
  REFUSED(def.axis = 3, MSQ_E_ARGUMENT, "period.axis is 3");
  REFUSED(def.count = 0, MSQ_E_ARGUMENT, "period.count is 0; it must be from 1 to 4096");
  REFUSED(def.count = 4097, MSQ_E_ARGUMENT, "period.count is 4097");
  REFUSED(def.count = UINT64_MAX, MSQ_E_ARGUMENT, "period.count is 18446744073709551615");
  REFUSED(def.positions = NULL, MSQ_E_ARGUMENT, "period.positions is NULL");
  REFUSED(def.cell_sizes = NULL, MSQ_E_ARGUMENT, "period.cell_sizes is NULL");
  for (int which = 0; which < 3; ++which) {
    REFUSED(s[2] = not_finite(which), MSQ_E_ARGUMENT, "period.positions[2]");
    REFUSED(h[1] = not_finite(which), MSQ_E_ARGUMENT, "period.cell_sizes[1]");
  }
  REFUSED(h[3] = 0, MSQ_E_ARGUMENT, "period.cell_sizes[3] is 0; it must be from 1e-75 to 1e75");
  REFUSED(h[3] = -1, MSQ_E_ARGUMENT, "period.cell_sizes[3] is -1;");
  REFUSED(s[2] = 0.5, MSQ_E_ARGUMENT, "period.positions[2] is 0.5, not above the one before it");
  REFUSED(s[1] = -3, MSQ_E_ARGUMENT, "would fold there");
  REFUSED(s[2] = 0.5 + 1e-7, MSQ_E_ARGUMENT, "cells of these sizes need 6e-07");
  REFUSED(h[0] = 1000, MSQ_E_ARGUMENT, "the largest may be 1024 times the smallest");
  REFUSED(s[3] = 1e9, MSQ_E_LIMIT, "period.positions[3] is 1e+09");
  REFUSED(s[0] = -1e300, MSQ_E_LIMIT, "the limit is 1.67772e+07");
#undef REFUSED
  msq_context_release(context);
}

static void what_does_not_go_with_a_period_is_refused(void** state) {
  msq_context* context = make_context();
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 1};
  const msq_period_def period = period_def();
  msq_functional_def def = functional_def(&period);
  msq_field* field;
  msq_structure* structure;
  double cell_size[3] = {7, 7, 7};
  (void)state;
  assert_ok(msq_field_gradient(context, from, 0.01, to, 0.02, &field));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0;
  def.thickness.field = field;
  assert_refused(create(context, &def), MSQ_E_UNSUPPORTED, "thickness is a field");
  def.thickness.field = NULL;
  def.thickness.value = 0.3;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "thickness is 0.3; walls of");
  def.thickness.value = 0.02;
  assert_ok(msq_structure_functional(context, &def, &structure));
  assert_refused(msq_fill_calibrate(context, structure, 0.4, 0.1, cell_size, NULL),
                 MSQ_E_UNSUPPORTED, "period");
  assert_true(cell_size[0] == 7 && cell_size[1] == 7 && cell_size[2] == 7);
  msq_structure_release(structure);
  msq_field_release(field);
  msq_context_release(context);
}

/* ---- the solid, against the C library's sines and the integral of the frequency */

enum { samples = turned_side * turned_side * turned_side };

static void cells_have_their_sizes(void** state) {
  msq_context* context = make_context();
  static uint8_t inside[samples];
  const double c = cos(0.5), s = sin(0.5);
  const double rotation[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  (void)state;
  for (int axis = 0; axis < 3; ++axis)
    for (int is_turned = 0; is_turned < 2; ++is_turned) {
      msq_period_def period = period_def();
      double copied[4];
      memcpy(copied, sizes, sizeof copied);
      period.axis = axis;
      period.cell_sizes = copied;
      msq_functional_def def = functional_def(&period);
      def.grid.cell_size[0] = 1.25;
      def.grid.cell_size[axis] = 100; /* ignored */
      def.grid.origin[1] = 0.3;
      if (is_turned) memcpy(def.grid.rotation, rotation, sizeof rotation);
      msq_structure* structure;
      assert_ok(msq_structure_functional(context, &def, &structure));
      memset(copied, 0, sizeof copied);
      msq_model* model = make_model(context, make_box_of(context, -2, 2), structure, NULL);
      double length;
      assert_ok(msq_model_scale_length(model, 1, &length));
      assert_true(length == (axis == 0 ? 1 : 1.25));
      const msq_points_def points = turned_points();
      assert_ok(msq_set_membership(model, &points, NULL, inside, samples, NULL));
      int held = 0;
      for (int i = 0; i < samples; ++i) {
        double g[3], u[3];
        turned_position(&points, i, is_turned ? rotation : NULL, g);
        for (int a = 0; a < 3; ++a) u[a] = turn * g[a] / (a == 0 ? 1.25 : 1);
        u[axis] = turn * (integral(g[axis]) - integral(0));
        const double onset = sin(u[0]) * cos(u[1]) + sin(u[1]) * cos(u[2]) + sin(u[2]) * cos(u[0]);
        held += inside[i];
        if (fabs(onset - 0.25) > 1e-12) assert_int_equal(inside[i], onset <= 0.25);
      }
      assert_in_range(held, 1, samples - 1);
      msq_model_release(model);
    }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(what_makes_no_map_is_refused),
      cmocka_unit_test(what_does_not_go_with_a_period_is_refused),
      cmocka_unit_test(cells_have_their_sizes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
