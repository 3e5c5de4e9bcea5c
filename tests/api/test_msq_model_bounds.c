/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static void bounds_are_those_of_the_shape(void** state) {
  const double low[3] = {-1, 2, 0.5}, high[3] = {3, 2.5, 8};
  double min[3], max[3];
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_box(context, low, high, &shape));
  msq_model* model = make_model(context, shape, make_lattice(context), NULL);
  assert_ok(msq_model_bounds(model, min, max));
  assert_memory_equal(min, low, sizeof low);
  assert_memory_equal(max, high, sizeof high);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bounds_are_those_of_the_shape),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
