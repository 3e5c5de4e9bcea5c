/* SPDX-License-Identifier: Apache-2.0
 * msq_context_def_init, msq_context_create, msq_context_retain, msq_context_release. */
#include "definitions.h"

static void defaults_are_those_of_the_header(void** state) {
  msq_context_def def;
  (void)state;
  assert_ok(msq_context_def_init(&def, sizeof def));
  assert_int_equal(def.threads, 0);
  assert_int_equal(def.cache_bytes, (uint64_t)1 << 30);
  assert_int_equal(def.memory_limit, 0);
  assert_int_equal(def.cache_policy, MSQ_CACHE_FIFO);
  assert_int_equal(def.beyond_cores, 0);
  assert_true(def.parallel_for == NULL);
  assert_null(def.parallel_for_user);
  assert_true(def.parallel_for_release == NULL);
}

static void no_definition_means_defaults(void** state) {
  msq_context* context;
  (void)state;
  assert_ok(msq_context_create(NULL, &context));
  assert_int_equal(cache_of(context).limit_bytes, (uint64_t)1 << 30);
  assert_int_equal(memory_of(context).limit_bytes, 0);
  msq_context_release(context);
}

static void definition_is_taken_over(void** state) {
  msq_context* context = make_context_of(1, 12345, 67890);
  (void)state;
  assert_int_equal(cache_of(context).limit_bytes, 12345);
  assert_int_equal(memory_of(context).limit_bytes, 67890);
  msq_context_release(context);
}

static void any_number_of_threads_gives_the_same_answers(void** state) {
  const uint32_t threads[] = {0, 1, 2, 3, 1000, UINT32_MAX};
  const msq_points_def points = grid_points(-0.1, 4.1, 23);
  uint8_t *first = (uint8_t*)malloc(23 * 23 * 23), *other = (uint8_t*)malloc(23 * 23 * 23);
  (void)state;
  for (size_t i = 0; i < sizeof threads / sizeof threads[0]; ++i) {
    msq_context* context = make_context_of(threads[i], 1 << 20, 0);
    msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
    assert_ok(msq_set_membership(model, &points, NULL, i ? other : first, 23 * 23 * 23, NULL));
    if (i) assert_memory_equal(first, other, 23 * 23 * 23);
    msq_model_release(model);
    msq_context_release(context);
  }
  free(first);
  free(other);
}

/* With more threads than cores, whatever the machine has. */
static void threads_may_exceed_the_cores(void** state) {
  const msq_points_def points = grid_points(-0.1, 4.1, 23);
  uint8_t *first = (uint8_t*)malloc(23 * 23 * 23), *other = (uint8_t*)malloc(23 * 23 * 23);
  (void)state;
  for (int i = 0; i < 2; ++i) {
    msq_context_def def;
    msq_context* context;
    assert_ok(msq_context_def_init(&def, sizeof def));
    def.threads = i ? 24 : 1;
    def.beyond_cores = 1;
    assert_ok(msq_context_create(&def, &context));
    msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
    assert_ok(msq_set_membership(model, &points, NULL, i ? other : first, 23 * 23 * 23, NULL));
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_memory_equal(first, other, 23 * 23 * 23);
  free(first);
  free(other);
}

static void retain_adds_a_reference(void** state) {
  msq_context* context = make_context();
  (void)state;
  msq_context_retain(context);
  msq_context_release(context);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_context_release(NULL);
  msq_context_retain(NULL);
}

/* A sanitizer build sees the misuse where this goes wrong. */
static void objects_outlive_the_hosts_reference(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  msq_structure* foam = make_foam(context, MSQ_FOAM_DIRECT);
  (void)state;
  msq_model* model = make_model(context, shape, foam, NULL);
  msq_context_release(context);
  is_inside(model, 1, 1, 1);
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20, 20, 0.5);
  msq_slicer* slicer = make_slicer(model, &def);
  msq_model_release(model);
  uint8_t layer[20 * 8];
  assert_ok(msq_slice_layer(slicer, 3, layer, sizeof layer, NULL));
  msq_slicer_release(slicer);
}

static void mesh_alone_outlives_its_context(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  (void)state;
  msq_context_release(context);
  assert_int_equal(info_of(shape).triangles, 12);
  msq_shape_release(shape);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(no_definition_means_defaults),
      cmocka_unit_test(definition_is_taken_over),
      cmocka_unit_test(any_number_of_threads_gives_the_same_answers),
      cmocka_unit_test(threads_may_exceed_the_cores),
      cmocka_unit_test(retain_adds_a_reference),
      cmocka_unit_test(release_of_null_does_nothing),
      cmocka_unit_test(objects_outlive_the_hosts_reference),
      cmocka_unit_test(mesh_alone_outlives_its_context),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
