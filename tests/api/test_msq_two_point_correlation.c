/* SPDX-License-Identifier: Apache-2.0
 * msq_two_point_correlation against closed forms. */
#include "samples.h"

enum { count = 6 };
static const double lengths[count] = {0, 0.05, 0.1, 0.2, 0.3, 0.25};

/* Plates of share p and period 1: along x both ends are in one plate with p - s, s up to p and 1 -
 * p; with t the cosine to x of a random direction, s becomes s |t|, 1 / 2 s on average. */
static void plates_have_theirs(void** state) {
  const double along[3] = {-7, 0, 0}, across[3] = {0, 0, 1e-200}, oblique[3] = {3, 4, 0};
  const double* directions[4] = {along, across, oblique, NULL};
  const double slopes[4] = {1, 0, 0.6, 0.5};
  msq_context* context = make_context();
  msq_model* model = make_plates(context);
  const msq_points_def sample =
      sample_of(-3, 3, (uint64_t)cbrt((double)test_count(50 * 50 * 50)), 2);
  (void)state;
  for (int d = 0; d < 4; ++d)
    for (int32_t phase = MSQ_PHASE_SOLID; phase <= MSQ_PHASE_VOID; ++phase) {
      const msq_segments_def def = segments_of(lengths, count, phase, directions[d]);
      const double share = phase == MSQ_PHASE_SOLID ? 0.3 : 0.7;
      msq_estimate found[count];
      assert_ok(msq_two_point_correlation(model, &sample, NULL, &def, found, count, NULL));
      for (int i = 0; i < count; ++i)
        assert_within(&found[i], share - slopes[d] * lengths[i], 1e-9);
      assert_true(found[1].standard_error < 0.003 / sqrt(fmin(1, test_scale())));
    }
  msq_model_release(model);
  msq_context_release(context);
}

/* One ball of radius R: its volume times 1 - 3 s / (4 R) + s^3 / (16 R^3) of the box. */
static void a_ball_has_its_own(void** state) {
  const double centre[3] = {2, 2, 2};
  const double apart[count] = {0, 0.3, 0.8, 1.5, 1.9, 2.1};
  msq_context* context = make_context();
  msq_shape* ball;
  msq_estimate found[count];
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 1, &ball));
  msq_model* model = make_shape_model(context, ball);
  const msq_points_def sample = sample_of(0, 4, 40, 2);
  const msq_segments_def def = segments_of(apart, count, MSQ_PHASE_SOLID, NULL);
  assert_ok(msq_two_point_correlation(model, &sample, NULL, &def, found, count, NULL));
  for (int i = 0; i < count; ++i) {
    const double s = apart[i];
    const double shape = s < 2 ? 1 - 3 * s / 4 + s * s * s / 16 : 0;
    assert_within(&found[i], 4.0 / 3 * pi / 64 * shape, 1e-9);
  }
  assert_true(found[5].value == 0 && found[5].high > 0);
  msq_model_release(model);
  msq_context_release(context);
}

static void threads_do_not_matter(void** state) {
  (void)state;
  check_threads(msq_two_point_correlation);
}

static void jobs_show_progress(void** state) {
  (void)state;
  check_segments_job(msq_two_point_correlation);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plates_have_theirs),
      cmocka_unit_test(a_ball_has_its_own),
      cmocka_unit_test(threads_do_not_matter),
      cmocka_unit_test(jobs_show_progress),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
