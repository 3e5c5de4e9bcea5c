/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static msq_model* make_three_scales(msq_context* context) {
  msq_foam_def def;
  msq_structure* foam;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.grid.cell_size[0] = 0.25;
  def.grid.cell_size[1] = 0.75;
  def.grid.cell_size[2] = 0.5;
  def.radius.value = 0.05;
  assert_ok(msq_structure_foam(context, &def, &foam));
  return make_model(context, make_box(context),
                    make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.3), foam);
}

static void length_is_the_largest_cell_size(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_three_scales(context);
  double length;
  (void)state;
  assert_ok(msq_model_scale_length(model, 0, &length));
  assert_true(isinf(length) && length > 0);
  assert_ok(msq_model_scale_length(model, 1, &length));
  assert_true(length == 2);
  assert_ok(msq_model_scale_length(model, 2, &length));
  assert_true(length == 0.75);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(length_is_the_largest_cell_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
