/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"
#include "layers.h"

static msq_status read_stats(void* env, void* report) {
  return msq_cache_stats((const msq_context*)env, (msq_cache_report*)report);
}

static void report_has_every_struct_size(void** state) {
  msq_context* context = make_context();
  (void)state;
  check_report_sizes(sizeof(msq_cache_report), read_stats, context);
  msq_context_release(context);
}

static void context_null_is_refused(void** state) {
  struct_bytes report;
  (void)state;
  memset(&report, struct_pattern, sizeof report);
  report.struct_size = sizeof(msq_cache_report);
  assert_refused(read_stats(NULL, &report), MSQ_E_ARGUMENT, "context is NULL");
  assert_filled(report.bytes + 4, sizeof report - 4, struct_pattern);
}

static void new_cache_is_empty(void** state) {
  msq_context* context = make_context_of(1, 4096, 0);
  const msq_cache_report report = cache_of(context);
  (void)state;
  assert_int_equal(report.reserved, 0);
  assert_int_equal(report.hits + report.misses + report.evictions, 0);
  assert_int_equal(report.bytes, 0);
  assert_int_equal(report.peak_bytes, 0);
  assert_int_equal(report.limit_bytes, 4096);
  msq_context_release(context);
}

/* A foam in a box of 8 x 8 x 4 cells, of several bricks. */
static msq_model* make_wide_foam_model(msq_context* context, int32_t method) {
  const double low[3] = {0, 0, 0}, high[3] = {8, 8, 4};
  msq_shape* box;
  assert_ok(msq_shape_from_box(context, low, high, &box));
  return make_model(context, box, make_foam(context, method), NULL);
}

/* Slices a foam and returns its layers. */
static layer_stack slice_foam(msq_context* context, int32_t method) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 64, 64, 0.2);
  msq_model* model = make_wide_foam_model(context, method);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack stack = run_all(slicer, MSQ_LAYER_BITS);
  msq_slicer_release(slicer);
  msq_model_release(model);
  return stack;
}

static void assert_within_limit(const msq_cache_report* report) {
  assert_true(report->bytes <= report->peak_bytes);
  assert_true(report->peak_bytes <= report->limit_bytes);
}

/* One method with a roomy cache, a small one and none: the same bytes, counters as they should. */
static void check_method(int32_t method) {
  msq_context* roomy = make_context();
  layer_stack wanted = slice_foam(roomy, method);
  const msq_cache_report first = cache_of(roomy);
  assert_true(first.misses > 0);
  assert_true(first.bytes > 0);
  assert_int_equal(first.evictions, 0);
  assert_within_limit(&first);

  /* The same slicer again finds all its cells. */
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 64, 64, 0.2);
  msq_model* model = make_wide_foam_model(roomy, method);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack once = run_all(slicer, MSQ_LAYER_BITS);
  const msq_cache_report before = cache_of(roomy);
  layer_stack twice = run_all(slicer, MSQ_LAYER_BITS);
  const msq_cache_report after = cache_of(roomy);
  assert_same_layers(&wanted, &once);
  assert_same_layers(&wanted, &twice);
  assert_true(after.hits > before.hits);
  assert_int_equal(after.misses, before.misses);
  assert_int_equal(after.bytes, before.bytes);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(roomy);
  free_stack(&once);
  free_stack(&twice);

  msq_context* small = make_context_of(2, first.bytes / 3, 0);
  layer_stack got = slice_foam(small, method);
  const msq_cache_report squeezed = cache_of(small);
  assert_same_layers(&wanted, &got);
  assert_true(squeezed.evictions > 0);
  assert_true(squeezed.bytes > 0);
  assert_within_limit(&squeezed);
  msq_context_release(small);
  free_stack(&got);

  msq_context* none = make_context_of(2, 0, 0);
  got = slice_foam(none, method);
  const msq_cache_report empty = cache_of(none);
  assert_same_layers(&wanted, &got);
  assert_true(empty.misses > 0);
  assert_int_equal(empty.hits + empty.evictions + empty.bytes + empty.peak_bytes, 0);
  msq_context_release(none);
  free_stack(&got);
  free_stack(&wanted);
}

static void direct_foam_is_the_same_at_any_cache_size(void** state) {
  (void)state;
  check_method(MSQ_FOAM_DIRECT);
}

#if MSQ_WITH_CGAL
static void method_2_foam_is_the_same_at_any_cache_size(void** state) {
  (void)state;
  check_method(MSQ_FOAM_METHOD_2);
}
#endif

static void foams_of_one_context_share_no_cells(void** state) {
  msq_context* context = make_context();
  (void)state;
  layer_stack first = slice_foam(context, MSQ_FOAM_DIRECT);
  const uint64_t misses = cache_of(context).misses;
  layer_stack second = slice_foam(context, MSQ_FOAM_DIRECT);
  assert_true(cache_of(context).misses > misses);
  assert_same_layers(&first, &second);
  free_stack(&first);
  free_stack(&second);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(report_has_every_struct_size),
    cmocka_unit_test(context_null_is_refused),
    cmocka_unit_test(new_cache_is_empty),
    cmocka_unit_test(direct_foam_is_the_same_at_any_cache_size),
#if MSQ_WITH_CGAL
    cmocka_unit_test(method_2_foam_is_the_same_at_any_cache_size),
#endif
    cmocka_unit_test(foams_of_one_context_share_no_cells),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
