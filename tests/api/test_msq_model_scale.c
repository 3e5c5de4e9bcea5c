/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

/* Handles of an object are equal; each is released by itself. */
static void scales_have_what_the_model_was_made_of(void** state) {
  msq_context* context = make_context();
  msq_shape *box = make_box(context), *shape;
  msq_structure* lattice = make_lattice(context);
  msq_structure* foam = make_foam(context, MSQ_FOAM_AUTO);
  msq_structure* structure;
  (void)state;
  msq_shape_retain(box);
  msq_structure_retain(lattice);
  msq_structure_retain(foam);
  msq_model* model = make_model(context, box, lattice, foam);
  shape = NULL;
  structure = lattice;
  assert_ok(msq_model_scale(model, 0, 0, &shape, &structure));
  assert_ptr_equal(shape, box);
  assert_null(structure);
  msq_shape_release(shape);
  shape = box;
  assert_ok(msq_model_scale(model, 0, 1, &shape, &structure));
  assert_null(shape);
  assert_ptr_equal(structure, lattice);
  msq_structure_release(structure);
  assert_ok(msq_model_scale(model, 0, 2, NULL, &structure));
  msq_structure_release(lattice);
  msq_structure_release(foam);
  msq_shape_release(box);
  msq_model_release(model);
  assert_ptr_equal(structure, foam);
  /* The last reference to it. */
  msq_calibration_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_structure_calibrate(context, structure, NULL, 0.1, NULL, NULL, 0, &report, NULL));
  msq_structure_release(structure);
  msq_context_release(context);
}

static void regions_have_scales_of_their_own(void** state) {
  msq_context* context = make_context();
  msq_structure *lattice = make_lattice(context), *structure;
  msq_shape* shape;
  (void)state;
  msq_structure_retain(lattice);
  msq_model* regions[2] = {make_model(context, make_box(context), NULL, NULL),
                           make_model(context, make_box(context), lattice, NULL)};
  msq_model* model;
  assert_ok(msq_model_regions(context, (const msq_model* const*)regions, 2, &model));
  assert_ok(msq_model_scale(model, 1, 1, NULL, &structure));
  assert_ptr_equal(structure, lattice);
  msq_structure_release(structure);
  msq_shape* own;
  assert_ok(msq_model_scale(model, 0, 0, &shape, NULL));
  assert_ok(msq_model_scale(regions[0], 0, 0, &own, NULL));
  assert_ptr_equal(shape, own);
  msq_shape_release(own);
  msq_shape_release(shape);
  assert_int_equal(msq_model_scale(model, 0, 1, NULL, &structure), MSQ_E_ARGUMENT);
  msq_structure_release(lattice);
  for (int i = 0; i < 2; ++i) msq_model_release(regions[i]);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scales_have_what_the_model_was_made_of),
      cmocka_unit_test(regions_have_scales_of_their_own),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
