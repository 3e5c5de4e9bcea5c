/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"
#include "layers.h"

static void new_cache_is_empty(void** state) {
  msq_context* context = make_context_of(1, 4096, 0);
  const msq_cache_report report = cache_of(context);
  (void)state;
  assert_int_equal(report.reserved, 0);
  assert_int_equal(report.hits + report.misses + report.evictions, 0);
  assert_int_equal(report.bytes, 0);
  assert_int_equal(report.peak_bytes, 0);
  assert_int_equal(report.limit_bytes, 4096);
  assert_int_equal(report.building_bytes + report.cells + report.duplicates + report.unkept, 0);
  msq_context_release(context);
}

/* A foam in a box of 8 x 8 x 4 cells, of several bricks. */
static msq_model* make_wide_foam_model(msq_context* context, int32_t method) {
  const double low[3] = {0, 0, 0}, high[3] = {8, 8, 4};
  msq_shape* box;
  assert_ok(msq_shape_from_box(context, low, high, &box));
  return make_model(context, box, make_foam(context, method), NULL);
}

/* Slices a foam and returns its layers; *report: while the foam lives, may be NULL. */
static layer_stack slice_foam(msq_context* context, int32_t method, msq_cache_report* report) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 64, 64, 0.2);
  msq_model* model = make_wide_foam_model(context, method);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack stack = run_all(slicer, MSQ_LAYER_BITS);
  if (report) *report = cache_of(context);
  msq_slicer_release(slicer);
  msq_model_release(model);
  return stack;
}

/* While all that was ever cached is kept or was evicted. */
static void assert_within_limit(const msq_cache_report* report) {
  assert_true(report->bytes <= report->peak_bytes);
  assert_true(report->peak_bytes <= report->limit_bytes);
  assert_int_equal(report->building_bytes, 0); /* no call is under way */
  assert_int_equal(report->misses,
                   report->cells + report->evictions + report->duplicates + report->unkept);
}

/* One method with a roomy cache, a small one and none: the same bytes, counters as they should. */
static void check_method(int32_t method) {
  msq_context* roomy = make_context();
  msq_cache_report first, squeezed, empty;
  layer_stack wanted = slice_foam(roomy, method, &first);
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
  layer_stack got = slice_foam(small, method, &squeezed);
  assert_same_layers(&wanted, &got);
  assert_true(squeezed.evictions > 0);
  assert_true(squeezed.bytes > 0);
  assert_within_limit(&squeezed);
  msq_context_release(small);
  free_stack(&got);

  msq_context* none = make_context_of(2, 0, 0);
  got = slice_foam(none, method, &empty);
  assert_same_layers(&wanted, &got);
  assert_true(empty.misses > 0);
  assert_int_equal(empty.hits + empty.evictions + empty.bytes + empty.peak_bytes, 0);
  assert_int_equal(empty.unkept, empty.misses);
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

static msq_context* make_context_by(int32_t policy, uint64_t cache_bytes) {
  msq_context_def def;
  msq_context* context;
  assert_ok(msq_context_def_init(&def, sizeof def));
  def.threads = 2;
  def.cache_bytes = cache_bytes;
  def.cache_policy = policy;
  assert_ok(msq_context_create(&def, &context));
  return context;
}

enum { set_side = 24, ray_side = 16 };

typedef struct answers {
  uint8_t inside[set_side * set_side * set_side];
  double distances[set_side * set_side];
  msq_ray_hit hits[ray_side * ray_side];
} answers;

/* Points and rays of a foam, at a cache size and policy. */
static void ask(int32_t method, int32_t policy, uint64_t cache_bytes, answers* got,
                msq_cache_report* of_sets, msq_cache_report* report) {
  msq_context* context = make_context_by(policy, cache_bytes);
  msq_model* model = make_wide_foam_model(context, method);
  msq_points_def points = grid_points(0, 4, set_side);
  double origins[ray_side * ray_side][3], directions[ray_side * ray_side][3];
  msq_rays_def rays;
  memset(got, 0, sizeof *got);
  assert_ok(msq_set_membership(model, &points, NULL, got->inside, sizeof got->inside, NULL));
  points.counts[2] = 1;
  assert_ok(msq_set_distance(model, &points, NULL, got->distances, set_side * set_side, NULL));
  *of_sets = cache_of(context);
  for (int i = 0; i < ray_side * ray_side; ++i) {
    const double u = i % ray_side * (8.0 / ray_side), v = i / ray_side * (4.0 / ray_side);
    const double origin[3] = {u, -1, v}, direction[3] = {0.1, 1, 0.05 * (i % 5)};
    memcpy(origins[i], origin, sizeof origin);
    memcpy(directions[i], direction, sizeof direction);
  }
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = ray_side * ray_side;
  rays.origins = origins;
  rays.directions = directions;
  assert_ok(msq_ray_cast(model, &rays, NULL, got->hits, rays.count, NULL));
  *report = cache_of(context);
  assert_within_limit(report);
  msq_model_release(model);
  msq_context_release(context);
}

/* Sets, distances and rays, with room for all cells, for some and for none. */
static void check_answers(int32_t method, int32_t first_policy) {
  answers *wanted = (answers*)malloc(sizeof *wanted), *got = (answers*)malloc(sizeof *got);
  msq_cache_report roomy, roomy_sets, report, sets;
  ask(method, MSQ_CACHE_FIFO, (uint64_t)1 << 30, wanted, &roomy_sets, &roomy);
  assert_true(roomy.misses > 0);
  for (int32_t policy = first_policy; policy <= MSQ_CACHE_SEGMENTED; ++policy) {
    const uint64_t limits[] = {0, roomy.bytes / 3, roomy.bytes * 2 / 3};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; ++i) {
      if (test_scale() < 0.5 && i != (size_t)policy) continue;
      ask(method, policy, limits[i], got, &sets, &report);
      assert_memory_equal(got, wanted, sizeof *got);
      /* (Rays that find no room for cells may do without.) */
      assert_true(sets.misses >= roomy_sets.misses - roomy_sets.duplicates);
      if (limits[i] > 0 || method != MSQ_FOAM_DIRECT) assert_true(report.misses > 0);
    }
  }
  free(wanted);
  free(got);
}

static void answers_are_the_same_at_any_cache_size(void** state) {
  (void)state;
  check_answers(MSQ_FOAM_DIRECT, MSQ_CACHE_FIFO);
  check_answers(MSQ_FOAM_METHOD_1, MSQ_CACHE_SEGMENTED);
#if MSQ_WITH_CGAL
  check_answers(MSQ_FOAM_METHOD_2, MSQ_CACHE_SEGMENTED);
#endif
}

static void foams_of_one_context_share_no_cells(void** state) {
  msq_context* context = make_context();
  msq_cache_report of_first, of_both;
  (void)state;
  msq_model* keep = make_wide_foam_model(context, MSQ_FOAM_DIRECT);
  layer_stack first = slice_foam(context, MSQ_FOAM_DIRECT, &of_first);
  layer_stack second = slice_foam(context, MSQ_FOAM_DIRECT, &of_both);
  assert_true(of_both.misses > of_first.misses);
  assert_same_layers(&first, &second);
  free_stack(&first);
  free_stack(&second);
  msq_model_release(keep);
  msq_context_release(context);
}

static void cast_some(const msq_model* model) {
  const double origin[3] = {1.3, -1, 2.2}, direction[3] = {0.1, 1, 0.05};
  double origins[64][3], directions[64][3];
  msq_ray_hit hits[64];
  msq_rays_def rays;
  for (int i = 0; i < 64; ++i) {
    memcpy(origins[i], origin, sizeof origin);
    memcpy(directions[i], direction, sizeof direction);
    origins[i][0] += 0.01 * i;
  }
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = 64;
  rays.origins = origins;
  rays.directions = directions;
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, 64, NULL));
}

/* Of points and layers, unless a method keeps no cells for them, and rays. */
static void fill_cache(msq_model* model, int32_t method) {
  for (int i = 0; i < 8; ++i) cast_some(model);
  if (method == MSQ_FOAM_POINT) return;
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 64, 64, 0.2);
  uint8_t inside[16 * 16 * 16];
  const msq_points_def points = grid_points(0, 4, 16);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack stack = run_all(slicer, MSQ_LAYER_BITS);
  free_stack(&stack);
  msq_slicer_release(slicer);
  assert_ok(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL));
}

/* With the last model that holds a foam go its cells, and no other's. */
static void released_foams_leave_no_cells(void** state) {
  (void)state;
  for (int32_t method = MSQ_FOAM_POINT; method <= MSQ_FOAM_METHOD_1; ++method) {
    if (method == MSQ_FOAM_METHOD_2 && !MSQ_WITH_CGAL) continue;
    msq_context* context = make_context();
    msq_model* kept = make_wide_foam_model(context, MSQ_FOAM_DIRECT);
    fill_cache(kept, MSQ_FOAM_DIRECT);
    const msq_cache_report before = cache_of(context);
    assert_true(before.cells > 0);

    const double low[3] = {0, 0, 0}, high[3] = {8, 8, 4};
    msq_shape *box, *second_box;
    assert_ok(msq_shape_from_box(context, low, high, &box));
    assert_ok(msq_shape_from_box(context, low, high, &second_box));
    msq_structure* foam = make_foam(context, method);
    msq_structure_retain(foam);
    msq_model* model = make_model(context, box, foam, NULL);
    msq_model* second = make_model(context, second_box, foam, NULL);
    fill_cache(model, method);
    const msq_cache_report both = cache_of(context);
    if (method != MSQ_FOAM_POINT) assert_true(both.bytes > before.bytes);
    msq_model_release(model);
    msq_cache_report after = cache_of(context);
    assert_int_equal(after.bytes, both.bytes);
    msq_model_release(second);
    after = cache_of(context);
    assert_int_equal(after.bytes, before.bytes);
    assert_int_equal(after.cells, before.cells);
    assert_int_equal(after.evictions, before.evictions);

    fill_cache(kept, MSQ_FOAM_DIRECT); /* its cells are still there */
    after = cache_of(context);
    assert_int_equal(after.misses, both.misses);
    msq_model_release(kept);
    after = cache_of(context);
    assert_int_equal(after.bytes + after.cells, 0);
    msq_context_release(context);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(new_cache_is_empty),
    cmocka_unit_test(direct_foam_is_the_same_at_any_cache_size),
#if MSQ_WITH_CGAL
    cmocka_unit_test(method_2_foam_is_the_same_at_any_cache_size),
#endif
    cmocka_unit_test(answers_are_the_same_at_any_cache_size),
    cmocka_unit_test(foams_of_one_context_share_no_cells),
    cmocka_unit_test(released_foams_leave_no_cells),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
