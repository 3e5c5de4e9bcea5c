/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"

static msq_context* context;
static msq_model* model; /* 0 to 4 in each axis, cells of 1 */

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

static msq_slicer_report plan_for(msq_slicer_def def) {
  msq_slicer* slicer = make_slicer(model, &def);
  const msq_slicer_report plan = plan_of(slicer);
  msq_slicer_release(slicer);
  assert_int_equal(plan.stride % 8, 0);
  assert_int_equal(plan.layer_bytes, plan.stride * plan.height);
  return plan;
}

static void resolution_divides_the_box(void** state) {
  const msq_slicer_report plan = plan_for(slicer_def(MSQ_LAYER_BITS, 16, 5, 0.5));
  (void)state;
  assert_int_equal(plan.width, 16);
  assert_int_equal(plan.height, 5);
  assert_int_equal(plan.layer_count, 8);
  assert_true(plan.pitch[0] == 0.25 && plan.origin[0] == 0.125);
  assert_near(plan.pitch[1], 0.8, 1e-15);
  assert_near(plan.origin[1], 0.4, 1e-15);
}

/* 4 / 0.3 pixels, rounded up, are wider than the box, and centred on it. */
static void pitch_counts_pixels_rounded_up_and_centred(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 0, 0, 0.3);
  (void)state;
  def.pitch[0] = 0.3;
  def.pitch[1] = 0.5;
  const msq_slicer_report plan = plan_for(def);
  assert_int_equal(plan.width, 14);
  assert_int_equal(plan.height, 8);
  assert_int_equal(plan.layer_count, 14);
  assert_true(plan.pitch[0] == 0.3 && plan.pitch[1] == 0.5);
  assert_near(plan.origin[0], 2 - 14 * 0.15 + 0.15, 1e-15);
  assert_near(plan.origin[1], 0.25, 1e-15);
}

/* 4 / 0.1 is 40 by a hair, whichever way it is rounded. */
static void rounding_makes_no_more_pixels(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 0, 0, 0.1);
  const double box = 4;
  (void)state;
  for (int i = 1; i <= 1000; i += 37) {
    def.pitch[0] = def.pitch[1] = def.layer_height = box / i;
    const msq_slicer_report plan = plan_for(def);
    assert_int_equal(plan.width, i);
    assert_int_equal(plan.height, i);
    assert_int_equal(plan.layer_count, i);
  }
  def.pitch[0] = def.pitch[1] = def.layer_height = 0.1;
  assert_int_equal(plan_for(def).width, 40);
  assert_int_equal(plan_for(def).layer_count, 40);
}

static void pitch_and_resolution_are_both_taken(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 10, 6, 0.5);
  (void)state;
  def.pitch[0] = def.pitch[1] = 0.5;
  const msq_slicer_report plan = plan_for(def);
  assert_int_equal(plan.width, 10);
  assert_int_equal(plan.height, 6);
  assert_near(plan.origin[0], 2 - 2.5 + 0.25, 1e-15);
  assert_near(plan.origin[1], 2 - 1.5 + 0.25, 1e-15);
}

static void region_puts_pixel_0_at_its_corner(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 0, 10, 0.4);
  (void)state;
  def.has_region = 1;
  def.region_min[0] = -1;
  def.region_min[1] = 1;
  def.region_min[2] = 0.5;
  def.region_max[0] = 0;
  def.region_max[1] = 2;
  def.region_max[2] = 1.5;
  def.pitch[0] = 0.3;
  const msq_slicer_report plan = plan_for(def);
  assert_int_equal(plan.width, 4);
  assert_int_equal(plan.height, 10);
  assert_int_equal(plan.layer_count, 3);
  assert_near(plan.origin[0], -0.85, 1e-15);
  assert_near(plan.origin[1], 1.05, 1e-15);
  assert_near(plan.pitch[1], 0.1, 1e-15);
}

/* Where all counts are given, region_max is not needed. */
static void region_needs_no_end_where_no_count_follows(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 7, 6, 0.4);
  (void)state;
  def.has_region = 1;
  def.region_min[0] = def.region_min[1] = def.region_min[2] = 1;
  def.pitch[0] = def.pitch[1] = 0.1;
  def.layer_count = 5;
  const msq_slicer_report plan = plan_for(def);
  assert_int_equal(plan.width, 7);
  assert_int_equal(plan.height, 6);
  assert_int_equal(plan.layer_count, 5);
  assert_near(plan.origin[0], 1.05, 1e-15);
}

static void stride_holds_the_width(void** state) {
  const uint32_t widths[] = {1, 7, 8, 9, 63, 64, 65, 128, 129};
  (void)state;
  for (size_t i = 0; i < sizeof widths / sizeof widths[0]; ++i) {
    const uint32_t width = widths[i];
    const msq_slicer_report bits = plan_for(slicer_def(MSQ_LAYER_BITS, width, 3, 0.5));
    const msq_slicer_report bytes = plan_for(slicer_def(MSQ_LAYER_BYTES, width, 3, 0.5));
    assert_int_equal(bits.width, width);
    assert_true(bits.stride * 8 >= width && bits.stride < width / 8 + 9);
    assert_true(bytes.stride >= width && bytes.stride < width + 8);
  }
}

static void layer_count_is_the_one_given(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8, 8, 0.5);
  (void)state;
  def.layer_count = 100; /* beyond the box too */
  assert_int_equal(plan_for(def).layer_count, 100);
  def.layer_count = INT32_MAX;
  assert_int_equal(plan_for(def).layer_count, INT32_MAX);
}

static void listed_heights_are_the_layers(void** state) {
  const double heights[3] = {-1, 2, 2.25};
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8, 8, 0);
  (void)state;
  def.layer_z = heights;
  def.layer_z_count = 3;
  assert_int_equal(plan_for(def).layer_count, 3);
}

static void slabs_are_whole_cells_high_unless_told(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8, 8, 1.0 / 80);
  (void)state;
  assert_int_equal(plan_for(def).slab_layers, 80); /* one */
  def.layer_height = 1.0 / 25;
  assert_int_equal(plan_for(def).slab_layers, 50); /* two: three are more than 64 */
  def.layer_height = 0.125;
  assert_int_equal(plan_for(def).slab_layers, 32); /* all there are */
  def.slab_layers = 5;
  assert_int_equal(plan_for(def).slab_layers, 5);
  def.slab_layers = UINT32_MAX; /* no more than there are */
  assert_int_equal(plan_for(def).slab_layers, 32);
  def.slab_layers = 0;
  def.layer_height = 2; /* cells of less than a layer */
  assert_int_equal(plan_for(def).slab_layers, 2);
}

/* Of a foam, whose cells serve many layers; of others, that is for 16 threads. */
static void slabs_are_no_more_than_32_mib(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8192, 8192, 0.03125); /* 8 MiB a layer */
  msq_model* const others = model;
  msq_context* own = make_context();
  (void)state;
  model = make_foam_model(own, MSQ_FOAM_AUTO);
  assert_int_equal(plan_for(def).slab_layers, 4);
  def = slicer_def(MSQ_LAYER_BITS, 1 << 20, 1 << 20, 0.03125);
  assert_int_equal(plan_for(def).slab_layers, 1);
  msq_model_release(model);
  msq_context_release(own);
  model = others;
}

static int32_t add_inside(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count;
  return 0;
}

/* So a small limit does not refuse a run that has room for lower slabs. */
static void slabs_are_no_more_than_a_quarter_of_the_memory_limit(void** state) {
  const uint64_t limits[] = {0, 64u << 20, 8u << 20, 4u << 20}, layer_bytes = 1024 / 8 * 1024;
  const uint32_t wanted[] = {64, 64, 16, 8};
  uint64_t pixels = 0;
  (void)state;
  for (int i = 0; i < 4; ++i) {
    msq_context* own = make_context_of(2, 1 << 16, limits[i]);
    msq_model* foam = make_foam_model(own, MSQ_FOAM_AUTO);
    const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 1024, 1024, 4.0 / 64);
    msq_slicer* slicer = make_slicer(foam, &def);
    uint64_t inside = 0;
    assert_int_equal(plan_of(slicer).layer_bytes, layer_bytes);
    assert_int_equal(plan_of(slicer).slab_layers, wanted[i]);
    assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, add_inside, &inside, NULL));
    if (i == 0) pixels = inside;
    assert_int_equal(inside, pixels);
    if (i > 0) assert_in_range(memory_of(own).peak_bytes, 2 * layer_bytes, limits[i]);
    msq_slicer_release(slicer);
    msq_model_release(foam);
    msq_context_release(own);
  }
}

static void slabs_of_one_thread_are_no_more_than_2_mib(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 4096, 1024, 0.03125); /* 512 KiB a layer */
  msq_model* const others = model;
  msq_context_def context_def;
  msq_context* own;
  (void)state;
  assert_ok(msq_context_def_init(&context_def, sizeof context_def));
  context_def.threads = 1;
  assert_ok(msq_context_create(&context_def, &own));
  model = make_box_model(own);
  assert_int_equal(plan_for(def).slab_layers, 4);
  msq_model_release(model);
  msq_context_release(own);
  model = others;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(resolution_divides_the_box),
      cmocka_unit_test(pitch_counts_pixels_rounded_up_and_centred),
      cmocka_unit_test(rounding_makes_no_more_pixels),
      cmocka_unit_test(pitch_and_resolution_are_both_taken),
      cmocka_unit_test(region_puts_pixel_0_at_its_corner),
      cmocka_unit_test(region_needs_no_end_where_no_count_follows),
      cmocka_unit_test(stride_holds_the_width),
      cmocka_unit_test(layer_count_is_the_one_given),
      cmocka_unit_test(listed_heights_are_the_layers),
      cmocka_unit_test(slabs_are_whole_cells_high_unless_told),
      cmocka_unit_test(slabs_are_no_more_than_32_mib),
      cmocka_unit_test(slabs_are_no_more_than_a_quarter_of_the_memory_limit),
      cmocka_unit_test(slabs_of_one_thread_are_no_more_than_2_mib),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
