/* SPDX-License-Identifier: Apache-2.0
 * msq_context_memory, and the memory limit that it accounts against. */
#include "definitions.h"
#include "layers.h"

static void new_context_holds_nothing(void** state) {
  msq_context* context = make_context_of(1, 0, 1000);
  const msq_memory_report report = memory_of(context);
  (void)state;
  assert_int_equal(report.reserved, 0);
  assert_int_equal(report.bytes, 0);
  assert_int_equal(report.peak_bytes, 0);
  assert_int_equal(report.limit_bytes, 1000);
  msq_context_release(context);
}

static void mesh_is_held_until_it_is_released(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  const uint64_t held = memory_of(context).bytes;
  (void)state;
  assert_true(held >= 8 * 3 * sizeof(double) + 12 * 3 * sizeof(uint32_t));
  assert_true(memory_of(context).peak_bytes >= held);
  msq_shape* second = make_cube_mesh(context);
  assert_int_equal(memory_of(context).bytes, 2 * held);
  msq_shape_release(second);
  assert_int_equal(memory_of(context).bytes, held);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  assert_true(memory_of(context).peak_bytes >= 2 * held);
  msq_context_release(context);
}

static void refused_mesh_leaves_nothing_held(void** state) {
  double corners[8][3];
  msq_context* context = make_context_of(1, 0, 300);
  (void)state;
  cube_corners(0, 4, corners);
  const msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
  assert_makes_nothing(msq_shape, msq_shape_from_mesh(context, &def, &made), MSQ_E_LIMIT, "300");
  assert_message_has("memory_limit");
  assert_message_has_number(8 * 3 * sizeof(double) + 12 * 3 * sizeof(uint32_t));
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void wrong_mesh_leaves_nothing_held(void** state) {
  const uint32_t triangles[1][3] = {{0, 1, 99}};
  double corners[8][3];
  msq_context* context = make_context();
  (void)state;
  cube_corners(0, 4, corners);
  const msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, triangles, 1);
  assert_makes_nothing(msq_shape, msq_shape_from_mesh(context, &def, &made), MSQ_E_MESH, "99");
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

/* Bytes that a run of this slicer takes at its peak, without a limit. */
static uint64_t run_peak(const msq_slicer_def* def) {
  msq_context* context = make_context_of(2, 0, 0);
  msq_model* model = make_lattice_model(context);
  msq_slicer* slicer = make_slicer(model, def);
  layer_stack stack = run_all(slicer, def->output);
  const msq_memory_report report = memory_of(context);
  assert_int_equal(report.bytes, 0);
  free_stack(&stack);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return report.peak_bytes;
}

static void slicer_run_needs_its_peak_and_no_more(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 100, 90, 0.25);
  def.slab_layers = 16; /* by itself a slab is lower where the limit is small */
  const uint64_t peak = run_peak(&def);
  (void)state;
  assert_true(peak > 0);
  for (int less = 0; less < 2; ++less) {
    msq_context* context = make_context_of(2, 0, peak - (uint64_t)less);
    msq_model* model = make_lattice_model(context);
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
    const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL);
    if (less) {
      assert_refused(status, MSQ_E_LIMIT, "memory_limit");
      assert_message_has_number(peak);
      assert_message_has_number(peak - 1);
      assert_int_equal(stack.taken, 0);
    } else {
      assert_ok(status);
      assert_int_equal(memory_of(context).peak_bytes, peak);
    }
    assert_int_equal(memory_of(context).bytes, 0);
    free_stack(&stack);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void refused_slice_layer_writes_nothing(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BYTES, 64, 64, 0.25);
  msq_context* context = make_context_of(1, 0, 500);
  msq_model* model = make_lattice_model(context);
  msq_slicer* slicer = make_slicer(model, &def);
  uint8_t layer[64 * 64];
  (void)state;
  memset(layer, struct_pattern, sizeof layer);
  assert_refused(msq_slice_layer(slicer, 0, layer, sizeof layer, NULL), MSQ_E_LIMIT, "500");
  assert_filled(layer, sizeof layer, struct_pattern);
  assert_int_equal(memory_of(context).bytes, 0);
  assert_int_equal(memory_of(context).peak_bytes, 0);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static void refused_grid_query_writes_nothing(void** state) {
  const msq_points_def points = grid_points(0, 4, 16);
  msq_context* context = make_context_of(1, 0, 700);
  msq_model* model = make_lattice_model(context);
  uint8_t inside[16 * 16 * 16];
  (void)state;
  memset(inside, struct_pattern, sizeof inside);
  assert_refused(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL), MSQ_E_LIMIT,
                 "700");
  assert_filled(inside, sizeof inside, struct_pattern);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_model_release(model);
  msq_context_release(context);
}

/* Cells that find no room are computed and not kept. */
static void cached_cells_give_way_to_the_limit(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 60, 60, 0.1);
  msq_context* wide = make_context();
  msq_model* model = make_foam_model(wide, MSQ_FOAM_DIRECT);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack wanted = run_all(slicer, MSQ_LAYER_BITS);
  const uint64_t peak = memory_of(wide).peak_bytes, cached = cache_of(wide).bytes;
  (void)state;
  assert_int_equal(memory_of(wide).bytes, cached);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(wide);

  const uint64_t limit = peak - cached + cached / 4;
  msq_context* tight = make_context_of(2, (uint64_t)1 << 30, limit);
  model = make_foam_model(tight, MSQ_FOAM_DIRECT);
  slicer = make_slicer(model, &def);
  layer_stack got = run_all(slicer, MSQ_LAYER_BITS);
  assert_same_layers(&wanted, &got);
  assert_true(memory_of(tight).peak_bytes <= limit);
  assert_int_equal(memory_of(tight).bytes, cache_of(tight).bytes);
  free_stack(&wanted);
  free_stack(&got);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(tight);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(new_context_holds_nothing),
      cmocka_unit_test(mesh_is_held_until_it_is_released),
      cmocka_unit_test(refused_mesh_leaves_nothing_held),
      cmocka_unit_test(wrong_mesh_leaves_nothing_held),
      cmocka_unit_test(slicer_run_needs_its_peak_and_no_more),
      cmocka_unit_test(refused_slice_layer_writes_nothing),
      cmocka_unit_test(refused_grid_query_writes_nothing),
      cmocka_unit_test(cached_cells_give_way_to_the_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
