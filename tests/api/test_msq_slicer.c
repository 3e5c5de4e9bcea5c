/* SPDX-License-Identifier: Apache-2.0
 * msq_slicer_def_init, msq_slicer_create, msq_slicer_retain, msq_slicer_release. What becomes of a
 * definition: test_msq_slicer_info.c, test_msq_slicer_height.c. */
#include "definitions.h"

DEFINE_INIT(slicer_def)

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

static msq_status create(void* env, void* def) {
  msq_slicer* slicer = (msq_slicer*)untouched();
  const msq_status status =
      msq_slicer_create((const msq_model*)env, (const msq_slicer_def*)def, &slicer);
  if (status == MSQ_OK)
    msq_slicer_release(slicer);
  else
    assert_ptr_equal(slicer, untouched());
  return status;
}

/* 32 x 32 pixels, 16 layers: a definition to spoil. */
static msq_slicer_def good(void) {
  return slicer_def(MSQ_LAYER_BITS, 32, 32, 0.25);
}

static void assert_def_refused(msq_slicer_def def, msq_status status, const char* text) {
  assert_refused(create(model, &def), status, text);
}

static void def_init_honours_every_size(void** state) {
  (void)state;
  check_grown_def_init(init_slicer_def, offsetof(msq_slicer_def, window), sizeof(msq_slicer_def));
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

static void create_honours_every_struct_size(void** state) {
  const msq_slicer_def def = good();
  (void)state;
  check_grown_def_sizes(&def, offsetof(msq_slicer_def, window), sizeof def, create, model);
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

static void null_arguments_are_refused(void** state) {
  msq_slicer_def def = good();
  (void)state;
  assert_refused(create(NULL, &def), MSQ_E_ARGUMENT, "model is NULL");
  assert_refused(create(model, NULL), MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(msq_slicer_create(model, &def, NULL), MSQ_E_ARGUMENT, "slicer is NULL");
}

static void unknown_numbers_are_refused(void** state) {
  msq_slicer_def def = good();
  (void)state;
  def.output = 0;
  assert_def_refused(def, MSQ_E_ARGUMENT, "output is 0;");
  def.output = 6;
  assert_def_refused(def, MSQ_E_ARGUMENT, "output is 6;");
  assert_message_has("from 1 to 5");
  def = good();
  def.has_region = 2;
  assert_def_refused(def, MSQ_E_ARGUMENT, "has_region is 2;");
  def.has_region = -1;
  assert_def_refused(def, MSQ_E_ARGUMENT, "has_region is -1;");
}

static void wrong_pitches_are_refused(void** state) {
  const double refused[] = {-0.125, NAN, INFINITY};
  const char* texts[] = {"-0.125", "nan", "inf"};
  (void)state;
  for (int axis = 0; axis < 2; ++axis) {
    for (int i = 0; i < 3; ++i) {
      msq_slicer_def def = good();
      def.pitch[axis] = refused[i];
      assert_def_refused(def, MSQ_E_ARGUMENT, "pitch");
      assert_message_has(texts[i]);
    }
    msq_slicer_def def = good();
    def.resolution[axis] = 0;
    assert_def_refused(def, MSQ_E_ARGUMENT, "neither pitch nor resolution");
    assert_message_has(axis ? "along y" : "along x");
    def = good(); /* so far away that pixels fall together */
    def.has_region = 1;
    def.region_min[axis] = 1e18;
    def.region_max[axis] = 2e18;
    def.region_max[1 - axis] = 1;
    def.region_max[2] = 1;
    def.pitch[axis] = 1e-3;
    assert_def_refused(def, MSQ_E_ARGUMENT, "pitch");
    assert_message_has("1e+18");
  }
}

static void wrong_layer_heights_are_refused(void** state) {
  const double refused[] = {0, -0.5, NAN, INFINITY};
  const char* texts[] = {"is 0;", "-0.5", "nan", "inf"};
  (void)state;
  for (int i = 0; i < 4; ++i) {
    msq_slicer_def def = good();
    def.layer_height = refused[i];
    assert_def_refused(def, MSQ_E_ARGUMENT, "layer_height");
    assert_message_has(texts[i]);
  }
}

static void wrong_regions_are_refused(void** state) {
  msq_slicer_def region = good();
  (void)state;
  region.has_region = 1;
  for (int axis = 0; axis < 3; ++axis) region.region_max[axis] = 4;
  assert_ok(create(model, &region));
  for (int axis = 0; axis < 3; ++axis) {
    for (int which = 0; which < 3; ++which) {
      msq_slicer_def def = region;
      def.region_min[axis] = not_finite(which);
      assert_def_refused(def, MSQ_E_ARGUMENT, "region_min");
      def = region;
      def.region_max[axis] = not_finite(which);
      assert_def_refused(def, MSQ_E_ARGUMENT, "region_max");
    }
    for (int empty = 0; empty < 2; ++empty) {
      msq_slicer_def def = region;
      def.region_max[axis] = empty ? 0 : -1.5;
      assert_def_refused(def, MSQ_E_ARGUMENT, "extent");
      assert_message_has(empty ? "is 0;" : "-1.5");
    }
  }
}

static void wrong_heights_are_refused(void** state) {
  double heights[4] = {0.5, 1, 1.5, 2};
  msq_slicer_def def = good();
  (void)state;
  def.layer_z = heights;
  def.layer_z_count = 4;
  assert_ok(create(model, &def));
  def.layer_z_count = 0;
  assert_def_refused(def, MSQ_E_ARGUMENT, "layer_z_count is 0");
  def.layer_z_count = (uint64_t)1 << 31;
  assert_def_refused(def, MSQ_E_ARGUMENT, "2147483648");
  assert_message_has("2147483647");
  def.layer_z_count = 4;
  def.layer_count = 3;
  assert_def_refused(def, MSQ_E_ARGUMENT, "layer_count is 3");
  assert_message_has("4");
  def.layer_count = 4;
  assert_ok(create(model, &def));
  heights[2] = 1;
  assert_def_refused(def, MSQ_E_ARGUMENT, "layer_z[2]");
  assert_message_has("ascend");
  heights[2] = 0.75;
  assert_def_refused(def, MSQ_E_ARGUMENT, "0.75");
  for (int which = 0; which < 3; ++which) {
    heights[2] = not_finite(which);
    assert_def_refused(def, MSQ_E_ARGUMENT, "layer_z");
    assert_message_has("finite");
  }
  def.layer_z = NULL;
  assert_def_refused(def, MSQ_E_ARGUMENT, "layer_z is NULL");
}

static void wrong_length_scales_are_refused(void** state) {
  const double refused[] = {-0.5, NAN, -INFINITY};
  const char* texts[] = {"-0.5", "nan", "-inf"};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    msq_slicer_def def = good();
    def.length_scale = refused[i];
    assert_def_refused(def, MSQ_E_ARGUMENT, "length_scale");
    assert_message_has(texts[i]);
  }
}

static void too_many_pixels_or_layers_are_refused(void** state) {
  (void)state;
  for (int axis = 0; axis < 2; ++axis) {
    msq_slicer_def def = good();
    def.resolution[axis] = (uint32_t)1 << 31;
    assert_def_refused(def, MSQ_E_LIMIT, "2147483648");
    assert_message_has("2147483647");
    def = good();
    def.resolution[axis] = 0;
    def.pitch[axis] = 4e-12;
    assert_def_refused(def, MSQ_E_LIMIT, "1e+12");
    assert_message_has("2147483647");
    def.pitch[axis] = 5e-324;
    assert_def_refused(def, MSQ_E_LIMIT, "2147483647");
  }
  msq_slicer_def def = good();
  def.layer_count = (uint64_t)1 << 31;
  assert_def_refused(def, MSQ_E_LIMIT, "2147483648");
  assert_message_has("2147483647");
  def.layer_count = UINT64_MAX;
  assert_def_refused(def, MSQ_E_LIMIT, "18446744073709551615");
  def = good();
  def.layer_height = 4e-12;
  assert_def_refused(def, MSQ_E_LIMIT, "1e+12");
  assert_message_has("2147483647");
  def = good();
  def.resolution[0] = def.resolution[1] = INT32_MAX;
  def.layer_count = INT32_MAX;
  def.layer_height = 1e-8;
  assert_def_refused(def, MSQ_E_LIMIT, "2^63");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(def_init_honours_every_size),
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(slicer_keeps_its_model_alive),
      cmocka_unit_test(release_of_null_does_nothing),
      cmocka_unit_test(null_arguments_are_refused),
      cmocka_unit_test(unknown_numbers_are_refused),
      cmocka_unit_test(wrong_pitches_are_refused),
      cmocka_unit_test(wrong_layer_heights_are_refused),
      cmocka_unit_test(wrong_regions_are_refused),
      cmocka_unit_test(wrong_heights_are_refused),
      cmocka_unit_test(wrong_length_scales_are_refused),
      cmocka_unit_test(too_many_pixels_or_layers_are_refused),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
