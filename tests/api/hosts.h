/* SPDX-License-Identifier: Apache-2.0
 * What the tests of objects that the host defines have in common. */
#ifndef HOSTS_H
#define HOSTS_H

#define _POSIX_C_SOURCE 200809L /* nanosleep */

#include <pthread.h>
#include <time.h>

#include "definitions.h"

/* The user of callbacks: what they saw. They run inside msq, so they assert nothing and note what
 * is wrong. Counters are for callbacks that come one at a time. */
typedef struct host_log {
  pthread_t thread;  /* that makes the calls to msq */
  const char* wrong; /* the first thing that was */
  uint64_t calls, points, released;
  int rests;        /* 1: the first calls take so long that other threads get to work, if any may */
  uint64_t fail_at; /* the call to fail at, from 1; 0: none */
  int32_t code;     /* to fail with */
  int bad;          /* 1: at the call to fail at, answer what cannot be instead */
  void* data;
} host_log;

static inline host_log make_log(void) {
  host_log log;
  memset(&log, 0, sizeof log);
  log.thread = pthread_self();
  return log;
}

/* To begin a callback with: its code. */
static inline int32_t note_call(host_log* log, uint64_t count) {
  if (!pthread_equal(pthread_self(), log->thread)) log->wrong = "thread";
  if (count < 1 || count > 4096) log->wrong = "count";
  if (log->released) log->wrong = "called after the release";
  log->points += count;
  if (log->rests && log->calls < 100) {
    const struct timespec millisecond = {0, 1000000};
    nanosleep(&millisecond, NULL);
  }
  return ++log->calls == log->fail_at ? log->code : 0;
}

static inline int is_bad_call(const host_log* log) {
  return log->bad && log->calls == log->fail_at;
}

static inline void note_release(void* user) {
  ++((host_log*)user)->released;
}

static inline void assert_right(const host_log* log) {
  if (log->wrong) fail_msg("a callback saw a wrong %s", log->wrong);
}

/* Asks a model in every way: single points, arrays, grids, slices. Each must say the same as the
 * other model, which the host has no part in. Returns how many samples are inside. */
enum { host_side = 22, host_samples = host_side * host_side * host_side };

static inline msq_points_def host_grid(double low, double high) {
  return grid_points(low, high, host_side);
}

static inline uint64_t count_inside(const msq_model* model, const msq_points_def* points,
                                    uint8_t* inside) {
  uint64_t count = 0;
  assert_ok(msq_set_membership(model, points, NULL, inside, host_samples, NULL));
  for (int i = 0; i < host_samples; ++i) count += inside[i];
  return count;
}

/* No thread but the calling one asks the host, however long it takes. */
static inline void assert_asked_by_caller_alone(const msq_model* model, host_log* log) {
  static uint8_t inside[host_samples];
  static double points[host_samples][3];
  const msq_points_def grid = host_grid(0.6, 3.2);
  msq_points_def array;
  uint64_t state = 9;
  for (int i = 0; i < host_samples; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&state, 0.6, 3.2);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = host_samples;
  log->rests = 1;
  log->calls = 0;
  count_inside(model, &array, inside);
  log->calls = 0;
  count_inside(model, &grid, inside);
  log->rests = 0;
  assert_right(log);
}

static inline uint64_t assert_same_solid(const msq_model* a, const msq_model* b, double low,
                                         double high) {
  static uint8_t of_a[host_samples], of_b[host_samples];
  static double points[host_samples][3];
  msq_points_def grid = host_grid(low, high), array;
  const uint64_t count = count_inside(a, &grid, of_a);
  assert_int_equal(count_inside(b, &grid, of_b), count);
  assert_memory_equal(of_a, of_b, host_samples);

  uint64_t state = 5;
  for (int i = 0; i < host_samples; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&state, low, high);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = host_samples;
  count_inside(a, &array, of_a);
  count_inside(b, &array, of_b);
  assert_memory_equal(of_a, of_b, host_samples);
  for (int i = 0; i < host_samples; i += 37)
    assert_int_equal(is_inside(a, points[i][0], points[i][1], points[i][2]), of_b[i]);

  msq_slicer_def def = slicer_def(MSQ_LAYER_BYTES, 67, 21, (high - low) / 7);
  def.has_region = 1;
  for (int axis = 0; axis < 3; ++axis) {
    def.region_min[axis] = low;
    def.region_max[axis] = high;
  }
  msq_slicer *slicer_a = make_slicer(a, &def), *slicer_b = make_slicer(b, &def);
  const msq_slicer_report plan = plan_of(slicer_a);
  assert_in_range(plan.layer_bytes, 1, sizeof of_a);
  for (uint64_t k = 0; k < plan.layer_count; ++k) {
    assert_ok(msq_slice_layer(slicer_a, k, of_a, sizeof of_a, NULL));
    assert_ok(msq_slice_layer(slicer_b, k, of_b, sizeof of_b, NULL));
    assert_memory_equal(of_a, of_b, plan.layer_bytes);
  }
  msq_slicer_release(slicer_a);
  msq_slicer_release(slicer_b);
  return count;
}

#endif
