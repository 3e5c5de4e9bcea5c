/* SPDX-License-Identifier: Apache-2.0
 * msq_job_create, msq_job_retain, msq_job_release. */
#include "fixtures.h"

static void new_job_has_done_nothing(void** state) {
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_true(progress_of(job) == 0);
  msq_job_release(job);
}

static void retain_adds_a_reference(void** state) {
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  msq_job_retain(job);
  msq_job_release(job);
  assert_ok(msq_job_cancel(job));
  msq_job_release(job);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_job_release(NULL);
  msq_job_retain(NULL);
}

static void job_serves_one_call_after_another(void** state) {
  const msq_points_def points = grid_points(0, 4, 9);
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  uint8_t inside[9 * 9 * 9];
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  for (int i = 0; i < 3; ++i) {
    assert_ok(msq_set_membership(model, &points, NULL, inside, sizeof inside, job));
    assert_true(progress_of(job) == 1);
  }
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(new_job_has_done_nothing),
      cmocka_unit_test(retain_adds_a_reference),
      cmocka_unit_test(release_of_null_does_nothing),
      cmocka_unit_test(job_serves_one_call_after_another),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
