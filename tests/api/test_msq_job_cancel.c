/* SPDX-License-Identifier: Apache-2.0
 * The calls here would take minutes if they were not cancelled: the test's time limit says that
 * cancelling is soon. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <time.h>

#include "definitions.h"
#include "layers.h"

static msq_job* make_job(void) {
  msq_job* job;
  assert_ok(msq_job_create(&job));
  return job;
}

static void calls_under_a_cancelled_job_stop_at_once(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.2);
  const msq_points_def grid = grid_points(0, 4, 10);
  const double coordinates[2][3] = {{1, 1, 1}, {2, 2, 2}};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
  msq_job* job = make_job();
  uint8_t inside[1000], layer[40 * 8];
  msq_points_def array;
  (void)state;
  assert_ok(msq_job_cancel(job));
  assert_ok(msq_job_cancel(job)); /* twice is as good as once */
  for (int again = 0; again < 2; ++again) {
    assert_refused(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_int_equal(stack.taken, 0);
    memset(layer, struct_pattern, sizeof layer);
    assert_refused(msq_slice_layer(slicer, 0, layer, sizeof layer, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_filled(layer, sizeof layer, struct_pattern);
    assert_refused(msq_set_membership(model, &grid, NULL, inside, 1000, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_ok(msq_points_def_init(&array, sizeof array));
    array.coordinates = coordinates;
    array.count = 2;
    assert_refused(msq_set_membership(model, &array, NULL, inside, 2, job), MSQ_E_CANCELLED,
                   "cancelled");
  }
  assert_ok(msq_set_membership(model, &array, NULL, inside, 2, NULL));
  assert_int_equal(memory_of(context).bytes, 0);
  free_stack(&stack);
  msq_job_release(job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static int32_t cancel_at_third(void* user, const msq_layer* layer) {
  return layer->index == 2 && msq_job_cancel((msq_job*)user) != MSQ_OK ? -1 : 0;
}

static void callback_may_cancel_its_own_run(void** state) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.02);
  (void)state;
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, 0, 0);
    msq_model* model = make_lattice_model(context);
    msq_slicer* slicer = make_slicer(model, &def);
    msq_job* job = make_job();
    assert_status(msq_slicer_run(slicer, 0, UINT64_MAX, cancel_at_third, job, job),
                  MSQ_E_CANCELLED);
    assert_int_equal(memory_of(context).bytes, 0);
    msq_job_release(job);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void* cancel_soon(void* job) {
  const struct timespec pause = {0, 20 * 1000 * 1000};
  nanosleep(&pause, NULL);
  return msq_job_cancel((msq_job*)job) == MSQ_OK ? NULL : job;
}

static pthread_t start_cancelling(msq_job* job) {
  pthread_t thread;
  assert_int_equal(pthread_create(&thread, NULL, cancel_soon, job), 0);
  return thread;
}

static void assert_cancelled(pthread_t thread) {
  void* failed;
  assert_int_equal(pthread_join(thread, &failed), 0);
  assert_null(failed);
}

/* A box of side 1000 with 10^9 cells. */
static msq_model* make_huge_model(msq_context* context, int32_t method) {
  return make_model(context, make_box_of(context, 0, 1000), make_foam(context, method), NULL);
}

static void another_thread_cancels_between_layers(void** state) {
  (void)state;
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, (uint64_t)1 << 24, 0);
    msq_model* model = make_lattice_model(context);
    msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 1e-8);
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
    msq_job* job = make_job();
    const pthread_t thread = start_cancelling(job);
    assert_status(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, job), MSQ_E_CANCELLED);
    assert_cancelled(thread);
    assert_nothing_wrong(&stack);
    assert_true(progress_of(job) < 1);
    assert_int_equal(memory_of(context).bytes, cache_of(context).bytes);
    free_stack(&stack);
    msq_job_release(job);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* The first layer alone would take minutes. */
static void check_cancel_within_a_layer(int32_t method) {
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, (uint64_t)1 << 24, 0);
    msq_model* model = make_huge_model(context, method);
    const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20000, 20000, 1);
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
    msq_job* job = make_job();
    const pthread_t thread = start_cancelling(job);
    assert_status(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, job), MSQ_E_CANCELLED);
    assert_cancelled(thread);
    assert_int_equal(stack.taken, 0);
    assert_int_equal(memory_of(context).bytes, cache_of(context).bytes);
    free_stack(&stack);
    msq_job_release(job);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void another_thread_cancels_within_a_layer_of_point_foam(void** state) {
  (void)state;
  check_cancel_within_a_layer(MSQ_FOAM_POINT);
}

static void another_thread_cancels_within_a_layer_of_direct_foam(void** state) {
  (void)state;
  check_cancel_within_a_layer(MSQ_FOAM_DIRECT);
}

static void another_thread_cancels_a_grid_query(void** state) {
  const uint64_t n = 400;
  const msq_points_def points = grid_points(0, 1000, n);
  msq_context* context = make_context();
  msq_model* model = make_huge_model(context, MSQ_FOAM_POINT);
  uint8_t* inside = (uint8_t*)malloc(n * n * n);
  msq_job* job = make_job();
  (void)state;
  assert_non_null(inside);
  const pthread_t thread = start_cancelling(job);
  assert_status(msq_set_membership(model, &points, NULL, inside, n * n * n, job), MSQ_E_CANCELLED);
  assert_cancelled(thread);
  assert_int_equal(memory_of(context).bytes, cache_of(context).bytes);
  free(inside);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

typedef struct cancelling_field {
  msq_job* job;
  uint64_t asked; /* points since the job was cancelled */
} cancelling_field;

static int32_t cancel_and_count(void* user, const double* points, uint64_t count, double* values) {
  cancelling_field* field = (cancelling_field*)user;
  field->asked += count;
  for (uint64_t i = 0; i < count; ++i) values[i] = 0.2 + 0.1 * sin(40 * points[3 * i]);
  return field->job && msq_job_cancel(field->job) != MSQ_OK ? -1 : 0;
}

/* Few struts in many samples, whose radii are those of a field without bounds. */
static void lattices_of_large_struts_stop_soon(void** state) {
  msq_context* context = make_context_of(1, 0, 0);
  const double rotation[9] = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
  cancelling_field counts = {NULL, 0};
  msq_host_field_def field_def;
  msq_field* field;
  msq_lattice_def def;
  msq_structure* lattice;
  msq_model* model;
  msq_slicer* slicer;
  const msq_slicer_def slices = slicer_def(MSQ_LAYER_BITS, 400, 400, 0.5);
  layer_stack stack;
  (void)state;
  assert_ok(msq_host_field_def_init(&field_def, sizeof field_def));
  field_def.evaluate = cancel_and_count;
  field_def.user = &counts;
  field_def.low = 0.1;
  field_def.high = 0.3;
  assert_ok(msq_field_host(context, &field_def, &field));
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_OCTET;
  def.radius.field = field;
  set_cell(&def.grid, 2);
  memcpy(def.grid.rotation, rotation, sizeof rotation);
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  model = make_model(context, make_box(context), lattice, NULL);
  slicer = make_slicer(model, &slices);
  stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
  counts.job = make_job();
  assert_refused(msq_slicer_run(slicer, 0, 1, take_layer, &stack, counts.job), MSQ_E_CANCELLED,
                 "cancelled");
  if (counts.asked > 1000) fail_msg("%llu points", (unsigned long long)counts.asked);
  free_stack(&stack);
  msq_job_release(counts.job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_field_release(field);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(calls_under_a_cancelled_job_stop_at_once),
      cmocka_unit_test(callback_may_cancel_its_own_run),
      cmocka_unit_test(another_thread_cancels_between_layers),
      cmocka_unit_test(another_thread_cancels_within_a_layer_of_point_foam),
      cmocka_unit_test(another_thread_cancels_within_a_layer_of_direct_foam),
      cmocka_unit_test(another_thread_cancels_a_grid_query),
      cmocka_unit_test(lattices_of_large_struts_stop_soon),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
