/* SPDX-License-Identifier: Apache-2.0 */
#include "layers.h"

typedef struct watched {
  msq_job* job;
  double last;
  int is_wrong;
} watched;

static int32_t watch(void* user, const msq_layer* layer) {
  watched* w = (watched*)user;
  double now = -1;
  (void)layer;
  if (msq_job_progress(w->job, &now) != MSQ_OK || now < w->last || now < 0 || now > 1)
    w->is_wrong = 1;
  w->last = now;
  return 0;
}

static void progress_of_a_run_rises_to_1(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20, 20, 0.1);
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_slicer* slicer = make_slicer(model, &def);
  watched w = {NULL, 0, 0};
  (void)state;
  assert_ok(msq_job_create(&w.job));
  for (int again = 0; again < 2; ++again) { /* starts anew with each call */
    w.last = 0;
    assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, watch, &w, w.job));
    assert_false(w.is_wrong);
    assert_true(w.last > 0.5 && w.last < 1);
    assert_true(progress_of(w.job) == 1);
  }
  msq_job_release(w.job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static void progress_of_a_layer_reaches_1(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20, 20, 0.1);
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_slicer* slicer = make_slicer(model, &def);
  uint8_t layer[20 * 8];
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_slice_layer(slicer, 1, layer, sizeof layer, job));
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

/* Many short queries, since workers report their progress in any order. */
static void progress_of_set_queries_reaches_1(void** state) {
  const uint64_t count = 4096 * 8;
  double* coordinates = (double*)calloc(3 * count, sizeof *coordinates);
  uint8_t* inside = (uint8_t*)malloc(count);
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_points_def array;
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = coordinates;
  array.count = count;
  for (size_t i = 0; i < test_count(500); ++i) {
    assert_ok(msq_set_membership(model, &array, NULL, inside, count, job));
    assert_true(progress_of(job) == 1);
  }
  const msq_points_def grid = grid_points(0, 4, 20);
  assert_ok(msq_set_membership(model, &grid, NULL, inside, 20 * 20 * 20, job));
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
  free(coordinates);
  free(inside);
}

static void work_on_nothing_is_done(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20, 20, 0.1);
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_slicer* slicer = make_slicer(model, &def);
  watched w = {NULL, 0, 0};
  msq_points_def none;
  (void)state;
  assert_ok(msq_job_create(&w.job));
  assert_ok(msq_points_def_init(&none, sizeof none));
  assert_ok(msq_set_membership(model, &none, NULL, NULL, 0, w.job));
  assert_true(progress_of(w.job) == 1);
  assert_ok(msq_slicer_run(slicer, 0, 0, watch, &w, w.job));
  assert_true(progress_of(w.job) == 1);
  msq_job_release(w.job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(progress_of_a_run_rises_to_1),
      cmocka_unit_test(progress_of_a_layer_reaches_1),
      cmocka_unit_test(progress_of_set_queries_reaches_1),
      cmocka_unit_test(work_on_nothing_is_done),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
