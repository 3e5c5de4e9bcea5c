/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_beams: the memory limit and the job. */
#include <pthread.h>

#include "beams.h"

static void memory_is_limited(void** state) {
  msq_context* context = make_context_of(1, 0, 300);
  msq_beams_def def = frame_def();
  (void)state;
  assert_refused(create(context, &def), MSQ_E_LIMIT, "beams");
  assert_message_has("300");
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

/* ---- jobs */

/* Past the checks of the arrays. */
static void* cancel_when_begun(void* job) {
  for (long i = 0; i < 2000000000 && !(progress_of((msq_job*)job) > 0.15); ++i) {
  }
  return msq_job_cancel((msq_job*)job) == MSQ_OK ? NULL : job;
}

static void jobs_tell_progress_and_cancel(void** state) {
  enum { many = 1 << 20 };
  double(*centres)[3] = (double(*)[3])malloc(many * sizeof *centres);
  uint32_t* indices = (uint32_t*)malloc(many * sizeof *indices);
  uint64_t random = 9;
  msq_context* context = make_context();
  msq_structure* made = NULL;
  msq_beams_def def;
  msq_job* job;
  int was_cancelled = 0;
  (void)state;
  for (uint32_t i = 0; i < many; ++i) {
    indices[i] = i;
    for (int axis = 0; axis < 3; ++axis) centres[i][axis] = random_between(&random, -1, 1);
  }
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = centres;
  def.node_count = many;
  def.balls = indices;
  def.ball_count = 1000;
  def.ball_radius = 0.001;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_structure_beams(context, &def, &made, job));
  assert_true(progress_of(job) == 1);
  msq_structure_release(made);
  made = (msq_structure*)untouched();
  assert_ok(msq_job_cancel(job));
  assert_refused(msq_structure_beams(context, &def, &made, job), MSQ_E_CANCELLED, "cancelled");
  assert_ptr_equal(made, untouched());
  msq_job_release(job);

  def.ball_count = many;
  for (int i = 0; i < 20 && !was_cancelled; ++i) { /* the call may be done before it is seen */
    pthread_t thread;
    void* failed;
    made = (msq_structure*)untouched();
    assert_ok(msq_job_create(&job));
    assert_int_equal(pthread_create(&thread, NULL, cancel_when_begun, job), 0);
    const msq_status status = msq_structure_beams(context, &def, &made, job);
    assert_int_equal(pthread_join(thread, &failed), 0);
    assert_null(failed);
    was_cancelled = status == MSQ_E_CANCELLED;
    if (was_cancelled)
      assert_ptr_equal(made, untouched());
    else
      msq_structure_release(made);
    msq_job_release(job);
  }
  assert_true(was_cancelled);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
  free(centres);
  free(indices);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(memory_is_limited),
      cmocka_unit_test(jobs_tell_progress_and_cancel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
