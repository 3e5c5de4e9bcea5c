/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"
#include "fields.h"

static msq_context* context;

static int set_up(void** state) {
  (void)state;
  context = make_context();
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_context_release(context);
  return 0;
}

static int32_t sum_of(void* user, const double* points, uint64_t count, double* values) {
  *(uint64_t*)user += count;
  for (uint64_t i = 0; i < count; ++i)
    values[i] = points[3 * i] + 2 * points[3 * i + 1] - points[3 * i + 2];
  return 0;
}

static msq_field* make_host(msq_values_fn evaluate, void* user) {
  msq_host_field_def def;
  msq_field* field;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  def.evaluate = evaluate;
  def.user = user;
  def.low = -100;
  def.high = 100;
  assert_ok(msq_field_host(context, &def, &field));
  return field;
}

/* From 0 at x = 1 to 6 at x = 4, and constant beyond. */
static msq_field* make_rise(void) {
  const double from[3] = {1, 0, 0}, to[3] = {4, 0, 0};
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, 0, to, 6, &field));
  return field;
}

static void values_are_those_of_the_field(void** state) {
  enum { n = 30, all = n * n * n };
  msq_points_def grid = grid_points(-1, 4.8, n);
  double* values = (double*)malloc(all * sizeof(double));
  uint64_t asked = 0;
  msq_field *rise = make_rise(), *host = make_host(sum_of, &asked);
  (void)state;
  assert_ok(msq_field_evaluate(context, rise, &grid, values, all, NULL));
  for (uint64_t i = 0; i < all; ++i) {
    const double x = -1 + (double)(i % n) * 0.2;
    assert_near(values[i], fmin(6, fmax(0, 2 * (x - 1))), 1e-13);
  }
  assert_ok(msq_field_evaluate(context, host, &grid, values, all, NULL));
  assert_int_equal(asked, all);
  for (uint64_t i = 0; i < all; ++i) {
    double p[3];
    assert_ok(msq_points_generate(&grid, i, 1, p));
    assert_true(values[i] == p[0] + 2 * p[1] - p[2]);
  }
  /* Windows, arrays of floats with strides, and samples. */
  grid.window.first[1] = 7;
  grid.window.count[0] = 5;
  grid.window.count[1] = 2;
  grid.window.count[2] = 1;
  double some[10], p[3];
  assert_ok(msq_field_evaluate(context, host, &grid, some, 10, NULL));
  for (uint64_t i = 0; i < 10; ++i) assert_true(some[i] == values[i % 5 + n * (7 + i / 5)]);
  const float floats[2][4] = {{1, 2, 3, -1}, {4, 5, 6, -1}};
  msq_points_def array;
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.kind = MSQ_POINTS_ARRAY;
  array.coordinate_type = MSQ_FLOAT32;
  array.coordinates = floats;
  array.stride = sizeof floats[0];
  array.count = 2;
  assert_ok(msq_field_evaluate(context, host, &array, some, 2, NULL));
  assert_true(some[0] == 2 && some[1] == 8);
  msq_points_def sample = grid_points(0, 1, 3);
  sample.kind = MSQ_POINTS_STRATIFIED;
  double sampled[27];
  assert_ok(msq_field_evaluate(context, host, &sample, sampled, 27, NULL));
  assert_ok(msq_points_generate(&sample, 26, 1, p));
  assert_true(sampled[26] == p[0] + 2 * p[1] - p[2]);
  msq_field_release(host);
  msq_field_release(rise);
  free(values);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(values_are_those_of_the_field),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
