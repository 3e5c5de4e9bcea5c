/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_retain, msq_shape_release. */
#include "fixtures.h"

static void retain_adds_a_reference(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  (void)state;
  msq_shape_retain(shape);
  msq_shape_release(shape);
  assert_int_equal(info_of(shape).triangles, 12);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_shape_release(NULL);
  msq_shape_retain(NULL);
}

static void one_shape_serves_many_models(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  (void)state;
  msq_shape_retain(shape);
  msq_shape_retain(shape);
  msq_model* first = make_shape_model(context, shape);
  msq_model* second = make_model(context, shape, make_lattice(context), NULL);
  msq_model_release(first);
  assert_int_equal(is_inside(second, 0.5, 0.5, 0.5), 1);
  msq_model_release(second);
  assert_true(memory_of(context).bytes > 0);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(retain_adds_a_reference),
      cmocka_unit_test(release_of_null_does_nothing),
      cmocka_unit_test(one_shape_serves_many_models),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
