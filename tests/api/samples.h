/* SPDX-License-Identifier: Apache-2.0
 * Samples and models that the tests of statistics share. */
#ifndef SAMPLES_H
#define SAMPLES_H

#include "fixtures.h"

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

static inline void check_segments_job(segments_fn ask) {
  const double lengths[2] = {0.5, 0};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_segments_def def = segments_of(lengths, 2, MSQ_PHASE_SOLID, NULL);
  const msq_points_def sample = sample_of(0, 4, 4, 2);
  msq_estimate estimates[2];
  msq_job* job;
  assert_ok(msq_job_create(&job));
  assert_ok(ask(model, &sample, NULL, &def, estimates, 2, job));
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_model_release(model);
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
