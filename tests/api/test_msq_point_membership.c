/* SPDX-License-Identifier: Apache-2.0
 * msq_query_def_init, msq_point_membership. */
#include <float.h>

#include "definitions.h"

static void defaults_are_those_of_the_header(void** state) {
  msq_query_def def;
  (void)state;
  assert_ok(msq_query_def_init(&def, sizeof def));
  assert_int_equal(def.method, MSQ_QUERY_AUTO);
  assert_int_equal(def.critical_count, 0);
  assert_true(def.length_scale == 0);
}

/* A lattice of cell 2, and one of cell 0.5 within its struts. */
static msq_model* make_nested(msq_context* context) {
  return make_model(context, make_box(context),
                    make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5),
                    make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.5, 0.1));
}

static void finer_scales_are_solid_at_a_length_scale(void** state) {
  /* In both lattices; in the coarse one alone; in the fine one alone. */
  const double points[3][3] = {{1.25, 0, 0.05}, {1.25, 0.25, 0.2}, {1.25, 1, 1}};
  const double scales[] = {0, 0.5, 0.50001, 2, 2.00001, INFINITY};
  const int wanted[6][3] = {{1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {1, 1, 1}};
  msq_context* context = make_context();
  msq_model* model = make_nested(context);
  msq_query_def def;
  (void)state;
  assert_ok(msq_query_def_init(&def, sizeof def));
  for (int i = 0; i < 6; ++i)
    for (int p = 0; p < 3; ++p) {
      int32_t inside;
      def.length_scale = scales[i];
      assert_ok(msq_point_membership(model, points[p], &def, &inside));
      assert_int_equal(inside, wanted[i][p]);
    }
  msq_model_release(model);
  msq_context_release(context);
}

static void far_points_are_outside(void** state) {
  const double far_away[] = {1e10, -1e300, DBL_MAX};
  msq_context* context = make_context();
  msq_model* models[3];
  (void)state;
  models[0] = make_lattice_model(context);
  models[1] = make_foam_model(context, MSQ_FOAM_AUTO);
  models[2] = make_shape_model(context, make_cube_mesh(context));
  for (int m = 0; m < 3; ++m) {
    for (int i = 0; i < 3; ++i) {
      assert_int_equal(is_inside(models[m], far_away[i], 1, 1), 0);
      assert_int_equal(is_inside(models[m], 1, far_away[i], 1), 0);
      assert_int_equal(is_inside(models[m], 1, 1, far_away[i]), 0);
    }
    msq_model_release(models[m]);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(finer_scales_are_solid_at_a_length_scale),
      cmocka_unit_test(far_points_are_outside),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
