/* SPDX-License-Identifier: Apache-2.0
 * msq_material_def_init, msq_material_create, msq_material_retain, msq_material_release. */
#include "materials.h"

static void a_model_keeps_its_materials(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_material_model(context, 1, 1, 1);
  uint32_t id = 9;
  (void)state;
  msq_context_release(context);
  assert_ok(msq_point_material(model, material_points[0], NULL, NULL, 0, &id, NULL));
  assert_int_equal(id, 2);
  msq_model_release(model);
  msq_material_retain(NULL);
  msq_material_release(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_model_keeps_its_materials),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
