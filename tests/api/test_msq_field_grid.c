/* SPDX-License-Identifier: Apache-2.0
 * msq_grid_field_def_init, msq_field_grid. */
#include "images.h"

static msq_grid_field_def grid_def(const msq_image* image) {
  msq_grid_field_def def;
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  def.image = *image;
  return def;
}

static void field_is_linear_between_values_and_constant_beyond(void** state) {
  msq_context* context = make_context();
  const msq_image image = small_image();
  const msq_grid_field_def def = grid_def(&image);
  msq_field* field;
  (void)state;
  assert_ok(msq_field_grid(context, &def, &field));
  assert_near(field_at(context, field, 1, 0, 0), 0, 1e-6);
  assert_near(field_at(context, field, 1.5, 0, 0), 9, 1e-6);
  assert_near(field_at(context, field, 1.25, 0, 0), 4.5, 1e-6);
  assert_near(field_at(context, field, 1, 0.5, 0), 27, 1e-6);
  assert_near(field_at(context, field, 1, 0.25, 0.75), 13.5 + 81 * 1.5, 1e-6);
  assert_near(field_at(context, field, 9, 9, 9), 234, 1e-6);
  assert_near(field_at(context, field, -9, -9, -9), 0, 1e-6);
  msq_field_release(field);
  msq_context_release(context);
}

/* A quarter turn about z: the image's x runs along y. */
static void image_may_be_turned(void** state) {
  const double quarter[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  msq_context* context = make_context();
  msq_image image = small_image();
  msq_field* field;
  (void)state;
  memcpy(image.grid.rotation, quarter, sizeof quarter);
  const msq_grid_field_def def = grid_def(&image);
  assert_ok(msq_field_grid(context, &def, &field));
  assert_near(field_at(context, field, 1, 0.5, 0), 9, 1e-6);
  assert_near(field_at(context, field, 0.5, 0, 0), 27, 1e-6);
  msq_field_release(field);
  msq_context_release(context);
}

static void every_type_of_value_is_read(void** state) {
  msq_context* context = make_context();
  const float float32[8] = {-0.5f, 1};
  const double float64[8] = {-0.5, 1};
  const uint8_t uint8[8] = {3, 200};
  const int16_t int16[8] = {-300, 200};
  const uint16_t uint16[8] = {3, 1000};
  const struct {
    int32_t type;
    const void* values;
    double wanted;
  } types[] = {{MSQ_FLOAT32, float32, 0.25},
               {MSQ_FLOAT64, float64, 0.25},
               {MSQ_UINT8, uint8, 101.5},
               {MSQ_INT16, int16, -50},
               {MSQ_UINT16, uint16, 501.5}};
  (void)state;
  for (size_t i = 0; i < sizeof types / sizeof types[0]; ++i) {
    msq_image image = small_image();
    msq_field* field;
    image.values = types[i].values;
    image.value_type = types[i].type;
    for (int axis = 0; axis < 3; ++axis) image.size[axis] = 2;
    const msq_grid_field_def def = grid_def(&image);
    assert_ok(msq_field_grid(context, &def, &field));
    assert_near(field_at(context, field, 1.25, 0, 0), types[i].wanted, 1e-6);
    msq_field_release(field);
  }
  msq_context_release(context);
}

/* The values are the library's own from the call on, and counted as long as the field lives. */
static void values_are_copied_and_counted(void** state) {
  msq_context* context = make_context();
  uint8_t values[27];
  msq_image image = small_image();
  msq_field* field;
  (void)state;
  memset(values, 7, sizeof values);
  image.values = values;
  const msq_grid_field_def def = grid_def(&image);
  assert_ok(msq_field_grid(context, &def, &field));
  memset(values, 9, sizeof values);
  assert_near(field_at(context, field, 1.3, 0.2, 0), 7, 1e-6);
  assert_true(memory_of(context).bytes >= 27);
  msq_field_release(field);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(field_is_linear_between_values_and_constant_beyond),
      cmocka_unit_test(image_may_be_turned),
      cmocka_unit_test(every_type_of_value_is_read),
      cmocka_unit_test(values_are_copied_and_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
