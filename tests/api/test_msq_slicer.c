/* SPDX-License-Identifier: Apache-2.0
 * msq_slicer_def_init, msq_slicer_create, msq_slicer_retain, msq_slicer_release. What becomes of a
 * definition: test_msq_slicer_info.c, test_msq_slicer_height.c. */
#include "definitions.h"

static msq_context* context;
static msq_model* model;

static int set_up(void** state) {
  (void)state;
  context = make_context();
  model = make_lattice_model(context);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}

/* 32 x 32 pixels, 16 layers. */
static msq_slicer_def good(void) {
  return slicer_def(MSQ_LAYER_BITS, 32, 32, 0.25);
}

static void defaults_are_those_of_the_header(void** state) {
  msq_slicer_def def;
  (void)state;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  assert_int_equal(def.output, MSQ_LAYER_BITS);
  assert_true(def.pitch[0] == 0 && def.pitch[1] == 0);
  assert_int_equal(def.resolution[0] + def.resolution[1], 0);
  assert_int_equal(def.layer_count, 0);
  assert_int_equal(def.has_region, 0);
  assert_int_equal(def.slab_layers, 0);
  assert_null(def.layer_z);
  assert_int_equal(def.layer_z_count, 0);
  assert_true(def.length_scale == 0);
}

static void slicer_keeps_its_model_alive(void** state) {
  msq_context* own = make_context();
  msq_model* lattice = make_model(own, make_cube_mesh(own), make_lattice(own), NULL);
  const msq_slicer_def def = good();
  msq_slicer* slicer = make_slicer(lattice, &def);
  uint8_t layer[32 * 8], again[32 * 8];
  (void)state;
  assert_ok(msq_slice_layer(slicer, 2, layer, sizeof layer, NULL));
  msq_context_release(own);
  msq_model_release(lattice);
  msq_slicer_retain(slicer);
  msq_slicer_release(slicer);
  assert_ok(msq_slice_layer(slicer, 2, again, sizeof again, NULL));
  assert_memory_equal(layer, again, sizeof layer);
  msq_slicer_release(slicer);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_slicer_release(NULL);
  msq_slicer_retain(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(slicer_keeps_its_model_alive),
      cmocka_unit_test(release_of_null_does_nothing),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
