/* SPDX-License-Identifier: Apache-2.0
 * Samples and models that the tests of statistics share. */
#ifndef SAMPLES_H
#define SAMPLES_H

#include "definitions.h"

static const double pi = 3.14159265358979323846;

/* side^3 cells over low to high. */
static inline msq_points_def sample_of(double low, double high, uint64_t side, uint32_t per_cell) {
  msq_points_def sample;
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = per_cell;
  for (int axis = 0; axis < 3; ++axis) {
    sample.origin[axis] = low;
    sample.counts[axis] = side;
    sample.spacing[axis] = (high - low) / (double)side;
  }
  return sample;
}

/* Within 4.5 standard errors, and a bias. */
static inline void assert_within(const msq_estimate* e, double known, double bias) {
  if (fabs(e->value - known) <= 4.5 * e->standard_error + bias) return;
  fail_msg("%.8f, standard error %.8f: not %.8f", e->value, e->standard_error, known);
}

/* Every way for a sample to be wrong. */
static inline void check_sample_refusals(use_fn ask, void* env) {
  const msq_points_def good = sample_of(0, 4, 4, 2);
  msq_points_def sample = good;
  sample.per_cell = 1;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "per_cell is 1");
  sample.per_cell = 4097;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "per_cell is 4097");
  sample = good;
  sample.kind = MSQ_POINTS_GRID;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "kind is 2");
  sample = good;
  sample.counts[2] = 0;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "counts[2] is 0");
  sample = good;
  sample.origin[1] = NAN;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "origin");
  sample = good;
  sample.struct_size = 1;
  assert_refused(ask(env, &sample), MSQ_E_ARGUMENT, "struct_size");
}

/* Plates normal to x of thickness 0.3, 1 apart, without end: a function of period 1. */
static inline msq_model* make_plates(msq_context* context) {
  msq_functional_def def;
  msq_structure* plates;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_EXPRESSION;
  def.expression = "x / (2 * pi)";
  def.level.value = 0.3;
  assert_ok(msq_structure_functional(context, &def, &plates));
  return make_model(context, make_box_of(context, -50, 50), plates, NULL);
}

static inline msq_segments_def segments_of(const double* lengths, uint64_t count, int32_t phase,
                                           const double* direction) {
  msq_segments_def def;
  assert_ok(msq_segments_def_init(&def, sizeof def));
  def.lengths = lengths;
  def.length_count = count;
  def.phase = phase;
  if (direction) memcpy(def.direction, direction, sizeof def.direction);
  return def;
}

typedef msq_status (*segments_fn)(const msq_model* model, const msq_points_def* sample,
                                  const msq_query_def* query, const msq_segments_def* def,
                                  msq_estimate* estimates, uint64_t estimate_count, msq_job* job);

typedef struct segments_call {
  segments_fn ask;
  msq_model* model;
} segments_call;

static inline msq_status ask_segments(void* env, void* def) {
  const segments_call* call = (const segments_call*)env;
  const msq_points_def sample = sample_of(0, 4, 4, 2);
  msq_estimate estimates[2];
  memset(estimates, struct_pattern, sizeof estimates);
  const msq_status status =
      call->ask(call->model, &sample, NULL, (const msq_segments_def*)def, estimates, 2, NULL);
  if (status != MSQ_OK) assert_filled(estimates, sizeof estimates, struct_pattern);
  return status;
}

static inline msq_status ask_of_sample(void* env, void* sample) {
  const segments_call* call = (const segments_call*)env;
  const double lengths[1] = {0.5};
  const msq_segments_def def = segments_of(lengths, 1, MSQ_PHASE_SOLID, NULL);
  msq_estimate estimate;
  memset(&estimate, struct_pattern, sizeof estimate);
  const msq_status status =
      call->ask(call->model, (const msq_points_def*)sample, NULL, &def, &estimate, 1, NULL);
  if (status != MSQ_OK) assert_filled(&estimate, sizeof estimate, struct_pattern);
  return status;
}

DEFINE_INIT(segments_def)

/* What msq_two_point_correlation and msq_lineal_path refuse. */
static inline void check_segments_refusals(segments_fn ask) {
  const double lengths[2] = {0.5, 0};
  const double wrong[4] = {-0.1, NAN, INFINITY, -INFINITY};
  msq_context* context = make_context();
  segments_call call = {ask, make_lattice_model(context)};
  const msq_segments_def good = segments_of(lengths, 2, MSQ_PHASE_SOLID, NULL);
  const msq_points_def sample = sample_of(0, 4, 4, 2);
  msq_estimate estimates[3];
  msq_job* job;
  check_def_init(init_segments_def, sizeof good);
  check_def_sizes(&good, sizeof good, ask_segments, &call);
  check_sample_refusals(ask_of_sample, &call);
  assert_refused(ask_segments(&call, NULL), MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(ask_of_sample(&call, NULL), MSQ_E_ARGUMENT, "sample is NULL");
  assert_refused(ask(NULL, &sample, NULL, &good, estimates, 2, NULL), MSQ_E_ARGUMENT,
                 "model is NULL");
  assert_refused(ask(call.model, &sample, NULL, &good, NULL, 2, NULL), MSQ_E_ARGUMENT,
                 "estimates is NULL");
  for (uint64_t count = 1; count <= 3; count += 2)
    assert_refused(ask(call.model, &sample, NULL, &good, estimates, count, NULL), MSQ_E_ARGUMENT,
                   "there are 2 lengths");
  msq_segments_def def = good;
  def.phase = 3;
  assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "phase is 3");
  def = good;
  def.lengths = NULL;
  assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "lengths is NULL");
  def = good;
  def.length_count = 0;
  assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "length_count is 0");
  def.length_count = 4097;
  assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "4097");
  for (int i = 0; i < 4; ++i) {
    const double some[2] = {1, wrong[i]};
    def = segments_of(some, 2, MSQ_PHASE_SOLID, NULL);
    assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "length 1 is ");
  }
  for (int which = 0; which < 3; ++which) {
    def = good;
    def.direction[which] = not_finite(which);
    assert_refused(ask_segments(&call, &def), MSQ_E_ARGUMENT, "direction");
  }
  assert_ok(msq_job_create(&job));
  assert_ok(ask(call.model, &sample, NULL, &good, estimates, 2, job));
  assert_true(progress_of(job) == 1);
  assert_ok(msq_job_cancel(job));
  memset(estimates, struct_pattern, sizeof estimates);
  assert_status(ask(call.model, &sample, NULL, &good, estimates, 2, job), MSQ_E_CANCELLED);
  assert_filled(estimates, sizeof estimates, struct_pattern);
  msq_job_release(job);
  msq_model_release(call.model);
  msq_context_release(context);
}

/* The same bits with 1 and 2 threads. */
static inline void check_threads(segments_fn ask) {
  const double lengths[3] = {0, 0.2, 1};
  msq_estimate estimates[2][3];
  for (uint32_t t = 0; t < 2; ++t) {
    msq_context* context = make_context_of(t + 1, 1 << 20, 0);
    msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
    const msq_points_def sample = sample_of(0, 4, 12, 3);
    const msq_segments_def def = segments_of(lengths, 3, MSQ_PHASE_SOLID, NULL);
    assert_ok(ask(model, &sample, NULL, &def, estimates[t], 3, NULL));
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_memory_equal(estimates[0], estimates[1], sizeof estimates[0]);
  assert_true(estimates[0][0].value > estimates[0][1].value);
}

#endif
