/* SPDX-License-Identifier: Apache-2.0
 * msq_point_material. */
#include "materials.h"

static uint32_t id_at(const msq_model* model, int point, double length_scale) {
  msq_query_def query;
  uint32_t id = 99;
  assert_ok(msq_query_def_init(&query, sizeof query));
  query.length_scale = length_scale;
  assert_ok(msq_point_material(model, material_points[point], &query, NULL, 0, &id, NULL));
  return id;
}

static void the_finest_scale_that_has_one_gives_it(void** state) {
  /* has a coarse, a fine, a skin material; ids on a strut, in the void, in the skin, outside */
  const int has[5][3] = {{1, 1, 1}, {1, 1, 0}, {1, 0, 0}, {1, 0, 1}, {0, 1, 0}};
  const uint32_t resolved[5][4] = {
      {2, 0, 3, 0}, {2, 0, 2, 0}, {1, 0, 1, 0}, {1, 0, 3, 0}, {2, 0, 2, 0}};
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 5; ++i) {
    msq_model* model = make_material_model(context, has[i][0], has[i][1], has[i][2]);
    for (int p = 0; p < 4; ++p) {
      assert_int_equal(id_at(model, p, 0), resolved[i][p]);
      if (has[i][0]) assert_int_equal(id_at(model, p, 1.5), p < 3 ? 1 : 0);
    }
    msq_model_release(model);
  }
  msq_context_release(context);
}

static void channels_come_in_the_order_asked_for(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_material_model(context, 1, 1, 1);
  const double wanted[4][2] = {{2, 200}, {0, 0}, {3, 300}, {0, 0}};
  (void)state;
  for (int p = 0; p < 4; ++p) {
    double values[3] = {7, 7, 7};
    uint32_t id;
    assert_ok(
        msq_point_material(model, material_points[p], NULL, material_channels, 2, &id, values));
    assert_true(values[0] == wanted[p][0] && values[1] == wanted[p][1] && values[2] == 7);
  }
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_finest_scale_that_has_one_gives_it),
      cmocka_unit_test(channels_come_in_the_order_asked_for),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
