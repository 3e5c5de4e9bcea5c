/* SPDX-License-Identifier: Apache-2.0
 * msq_voxels_def_init, msq_shape_from_voxels. */
#include "images.h"

static msq_voxels_def voxels_def(const msq_image* image) {
  msq_voxels_def def;
  assert_ok(msq_voxels_def_init(&def, sizeof def));
  def.image = *image;
  def.threshold = 100;
  return def;
}

/* Along z the values of a column grow by 81 from one to the next, 0.5 apart. */
static void solid_is_on_the_chosen_side_of_the_threshold(void** state) {
  (void)state;
  for (int32_t solid = MSQ_SOLID_ABOVE; solid <= MSQ_SOLID_BELOW; ++solid) {
    msq_context* context = make_context();
    const msq_image image = small_image();
    msq_voxels_def def = voxels_def(&image);
    msq_shape* shape;
    const int above = solid == MSQ_SOLID_ABOVE;
    def.solid = solid;
    def.threshold = 81;
    assert_ok(msq_shape_from_voxels(context, &def, &shape));
    msq_model* model = make_shape_model(context, shape);
    assert_int_equal(is_inside(model, 1, 0, 0.49), !above);
    assert_int_equal(is_inside(model, 1, 0, 0.5), 1); /* the threshold itself */
    assert_int_equal(is_inside(model, 1, 0, 0.51), above);
    assert_int_equal(is_inside(model, 1, 0, 1), above);
    assert_int_equal(is_inside(model, 1, 0, 1.01), 0); /* beyond the image */
    assert_int_equal(is_inside(model, 1, 0, -0.01), 0);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void info_says_what_the_header_says(void** state) {
  msq_context* context = make_context();
  const msq_image image = small_image();
  msq_voxels_def def = voxels_def(&image);
  msq_shape* shape;
  uint64_t pairs = 7;
  (void)state;
  def.threshold = -1;
  assert_ok(msq_shape_from_voxels(context, &def, &shape));
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 0);
  assert_int_equal(report.triangles, 0);
  assert_true(report.volume == 1);
  assert_true(isnan(report.area));
  assert_true(report.min[0] == 1 && report.min[1] == 0 && report.max[0] == 2 && report.max[2] == 1);
  assert_ok(msq_shape_self_intersections(shape, &pairs, NULL));
  assert_int_equal(pairs, 0);
  assert_true(memory_of(context).bytes >= 27);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void values_are_copied(void** state) {
  msq_context* context = make_context();
  uint8_t values[27];
  msq_image image = small_image();
  msq_shape* shape;
  (void)state;
  memset(values, 200, sizeof values);
  image.values = values;
  const msq_voxels_def def = voxels_def(&image);
  assert_ok(msq_shape_from_voxels(context, &def, &shape));
  memset(values, 0, sizeof values);
  msq_model* model = make_shape_model(context, shape);
  assert_int_equal(is_inside(model, 1.3, 0.2, 0.9), 1);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solid_is_on_the_chosen_side_of_the_threshold),
      cmocka_unit_test(info_says_what_the_header_says),
      cmocka_unit_test(values_are_copied),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
