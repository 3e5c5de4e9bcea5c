/* SPDX-License-Identifier: Apache-2.0
 * msq_volume_fraction, and what the statistics share: samples, standard errors, phases. */
#include "samples.h"

/* The ball of radius 1.5 in the box of 4, 100 samples of it. */
static void intervals_hold_the_truth_as_often_as_they_say(void** state) {
  const double centre[3] = {2, 2, 2}, known = 4.0 / 3 * pi * 1.5 * 1.5 * 1.5 / 64;
  msq_context* context = make_context();
  msq_shape* ball;
  enum { samples = 400 };
  int held = 0;
  double squares = 0, errors = 0;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 1.5, &ball));
  msq_model* model = make_shape_model(context, ball);
  for (uint64_t seed = 0; seed < samples; ++seed) {
    msq_points_def sample = sample_of(0, 4, 8, 2 + (uint32_t)(seed % 3));
    msq_estimate e;
    sample.seed = seed;
    assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &e, NULL));
    assert_true(e.low <= e.value && e.value <= e.high && e.low >= 0 && e.high <= 1);
    held += e.low <= known && known <= e.high;
    squares += (e.value - known) * (e.value - known);
    errors += e.standard_error * e.standard_error;
  }
  print_message("%d of %d intervals hold the truth; error %.3f of the standard error\n", held,
                samples, sqrt(squares / errors));
  /* 95 %, standard deviation 1.1 %; that of the ratio of 400 is 3.5 %. */
  assert_in_range(held, samples * 90 / 100, samples * 99 / 100);
  assert_near(sqrt(squares / errors), 1, 0.15);
  msq_model_release(model);
  msq_context_release(context);
}

static void models_have_their_known_fractions(void** state) {
  msq_context* context = make_context();
  msq_functional_def def;
  msq_structure* gyroid;
  msq_estimate solid, space;
  (void)state;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.level.value = 0.5;
  assert_ok(msq_structure_functional(context, &def, &gyroid));
  msq_model* model = make_model(context, make_box_of(context, -9, 9), gyroid, NULL);
  const msq_points_def sample = sample_of(-1, 1, 50, 4);
  assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &solid, NULL));
  assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_VOID, &space, NULL));
  assert_within(&solid, 0.661782, 1e-6);
  assert_near(solid.value + space.value, 1, 1e-12);
  assert_true(solid.standard_error == space.standard_error);
  assert_near(solid.low + space.high, 1, 1e-12);
  /* Strata count: independent points would be off by 6.7e-4. */
  assert_true(solid.standard_error < 2e-4);
  msq_model_release(model);

  model = make_box_model(context); /* half of the sample's box, in whole cells */
  const msq_points_def half = sample_of(2, 6, 4, 2);
  assert_ok(msq_volume_fraction(model, &half, NULL, MSQ_PHASE_SOLID, &solid, NULL));
  assert_near(solid.value, 0.125, 1e-12);
  assert_true(solid.standard_error == 0);
  assert_true(solid.low < 0.125 && solid.high > 0.125);
  msq_model_release(model);
  msq_context_release(context);
}

static void jobs_show_progress(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_points_def sample = sample_of(0, 4, 4, 2);
  msq_estimate e;
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &e, job));
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(intervals_hold_the_truth_as_often_as_they_say),
      cmocka_unit_test(models_have_their_known_fractions),
      cmocka_unit_test(jobs_show_progress),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
