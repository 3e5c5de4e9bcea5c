/* SPDX-License-Identifier: Apache-2.0 */
/* What msq_structure_beams refuses, the memory limit and the job. */
#include <pthread.h>

#include "beams.h"

#define REFUSED(change, status, text)                      \
  do {                                                     \
    msq_beams_def def = frame_def();                       \
    change;                                                \
    assert_refused(create(context, &def), (status), text); \
  } while (0)

static void null_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  msq_beams_def good = frame_def();
  (void)state;
  assert_refused(create(NULL, &good), MSQ_E_ARGUMENT, "context is NULL");
  assert_refused(create(context, NULL), MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(msq_structure_beams(context, &good, NULL, NULL), MSQ_E_ARGUMENT,
                 "structure is NULL");
  REFUSED(def.nodes = NULL, MSQ_E_ARGUMENT, "nodes is NULL, but node_count is 9");
  REFUSED(def.beams = NULL, MSQ_E_ARGUMENT, "beams is NULL, but beam_count is 7");
  REFUSED(def.balls = NULL, MSQ_E_ARGUMENT, "balls is NULL, but ball_count is 2");
  msq_context_release(context);
}

static void wrong_numbers_are_refused(void** state) {
  msq_context* context = make_context();
  (void)state;
  REFUSED(def.cap = -1, MSQ_E_ARGUMENT, "cap is -1; it must be from 0 to 2");
  REFUSED(def.cap = 3, MSQ_E_ARGUMENT, "cap is 3");
  REFUSED(def.coordinate_type = -1, MSQ_E_ARGUMENT, "coordinate_type is -1");
  REFUSED(def.coordinate_type = 77, MSQ_E_ARGUMENT, "coordinate_type is 77");
  REFUSED(def.reserved = 5, MSQ_E_ARGUMENT, "reserved is 5; it must be 0");
  REFUSED(def.beam_count = def.ball_count = 0, MSQ_E_ARGUMENT, "beam_count and ball_count are 0");
  REFUSED(def.beam_count = 2147483646, MSQ_E_LIMIT, "2147483646 and ball_count 2; the limit is");
  REFUSED(def.beam_count = UINT64_MAX, MSQ_E_LIMIT, "18446744073709551615");
  REFUSED(def.ball_count = UINT64_MAX, MSQ_E_LIMIT, "18446744073709551615");
  REFUSED(def.min_length = -0.5, MSQ_E_ARGUMENT, "min_length is -0.5");
  REFUSED(def.length_scale = -2, MSQ_E_ARGUMENT, "length_scale is -2");
  REFUSED(def.node_stride = 23, MSQ_E_ARGUMENT, "stride of nodes is 23 bytes; a point has 24");
  REFUSED(def.beam_stride = 7, MSQ_E_ARGUMENT, "stride of beams is 7 bytes; an element has 8");
  REFUSED(def.radius_stride = 15, MSQ_E_ARGUMENT, "stride of radii is 15 bytes");
  REFUSED(def.cap_stride = 1, MSQ_E_ARGUMENT, "stride of caps is 1 bytes");
  REFUSED(def.ball_stride = 3, MSQ_E_ARGUMENT, "stride of balls is 3 bytes");
  REFUSED(def.ball_radius_stride = 4, MSQ_E_ARGUMENT, "stride of ball_radii is 4 bytes");
  REFUSED(def.beam_stride = UINT64_MAX, MSQ_E_LIMIT, "beams: 7 times");
  for (int which = 0; which < 3; ++which) {
    REFUSED(def.min_length = not_finite(which), MSQ_E_ARGUMENT, "min_length is ");
    REFUSED(def.length_scale = not_finite(which), MSQ_E_ARGUMENT, "length_scale is ");
    REFUSED(def.radius = not_finite(which), MSQ_E_ARGUMENT, "radius is ");
    REFUSED(def.ball_radius = not_finite(which), MSQ_E_ARGUMENT, "ball_radius is ");
  }
  msq_context_release(context);
}

static void wrong_nodes_are_refused(void** state) {
  const double wrong[] = {NAN, INFINITY, -INFINITY, 1.5e75, -1.5e75};
  double some[node_count][3];
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 5; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      memcpy(some, nodes, sizeof some);
      some[5][axis] = some[8][axis] = wrong[i];
      REFUSED(def.nodes = some, MSQ_E_ARGUMENT, "node 5 is (");
      assert_message_has("finite");
    }
  msq_context_release(context);
}

static void node_indices_are_checked(void** state) {
  const uint32_t wrong[] = {node_count, UINT32_MAX};
  uint32_t some[beam_count][2], some_balls[ball_count];
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 2; ++i) {
    for (int end = 0; end < 2; ++end) {
      memcpy(some, beams, sizeof some);
      some[3][end] = some[6][end] = wrong[i];
      REFUSED(def.beams = some[0], MSQ_E_ARGUMENT, "beam 3 is at node ");
      assert_message_has_number(wrong[i]);
      assert_message_has("node_count is 9");
    }
    memcpy(some_balls, balls, sizeof some_balls);
    some_balls[1] = wrong[i];
    REFUSED(def.balls = some_balls, MSQ_E_ARGUMENT, "ball 1 is at node ");
    assert_message_has_number(wrong[i]);
  }
  msq_context_release(context);
}

static void wrong_radii_and_caps_are_refused(void** state) {
  const double wrong[] = {-0.5, 1.5e75, 1e-101, NAN, INFINITY, -INFINITY};
  const char* texts[] = {"is -0.5;", "is 1.5e+75;", "is 1e-101;", "nan", "inf", "-inf"};
  double some[beam_count][2], some_balls[ball_count];
  uint8_t some_caps[beam_count][2];
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 6; ++i) {
    for (int end = 0; end < 2; ++end) {
      memcpy(some, radii, sizeof some);
      some[2][end] = wrong[i];
      REFUSED(def.radii = some, MSQ_E_ARGUMENT,
              end ? "radius 1 of beam 2 " : "radius 0 of beam 2 ");
      assert_message_has(texts[i]);
    }
    memcpy(some_balls, ball_radii, sizeof some_balls);
    some_balls[0] = wrong[i];
    REFUSED(def.ball_radii = some_balls, MSQ_E_ARGUMENT, "radius of ball 0 ");
    assert_message_has(texts[i]);
    REFUSED((def.radii = NULL, def.radius = wrong[i]), MSQ_E_ARGUMENT, "radius is ");
    REFUSED((def.ball_radii = NULL, def.ball_radius = wrong[i]), MSQ_E_ARGUMENT, "ball_radius is ");
  }
  REFUSED(def.radii = NULL, MSQ_E_ARGUMENT, "radius is 0; without radii");
  REFUSED(def.ball_radii = NULL, MSQ_E_ARGUMENT, "ball_radius is 0; without ball_radii");
  memcpy(some, radii, sizeof some);
  some[4][0] = some[4][1] = 0;
  REFUSED(def.radii = some, MSQ_E_ARGUMENT, "the radii of beam 4 are both 0");
  memcpy(some_balls, ball_radii, sizeof some_balls);
  some_balls[1] = 0;
  REFUSED(def.ball_radii = some_balls, MSQ_E_ARGUMENT, "radius of ball 1 is 0");
  for (int end = 0; end < 2; ++end) {
    memcpy(some_caps, caps, sizeof some_caps);
    some_caps[5][end] = end ? 255 : 3;
    REFUSED(def.caps = some_caps[0], MSQ_E_ARGUMENT,
            end ? "cap 1 of beam 5 is 255; it must be from 0 to 2" : "cap 0 of beam 5 is 3");
  }
  msq_context_release(context);
}

static void beams_without_a_solid_are_refused(void** state) {
  const uint32_t pair[2] = {4, 4};
  msq_context* context = make_context();
  (void)state;
  msq_beams_def def = beam_def(0.5, MSQ_CAP_BUTT);
  def.nodes = nodes;
  def.node_count = node_count;
  def.beams = pair;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "1 beams and balls");
  def.cap = MSQ_CAP_HEMISPHERE; /* a ball */
  assert_ok(create(context, &def));
  msq_context_release(context);
}

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
      cmocka_unit_test(null_arguments_are_refused),
      cmocka_unit_test(wrong_numbers_are_refused),
      cmocka_unit_test(wrong_nodes_are_refused),
      cmocka_unit_test(node_indices_are_checked),
      cmocka_unit_test(wrong_radii_and_caps_are_refused),
      cmocka_unit_test(beams_without_a_solid_are_refused),
      cmocka_unit_test(memory_is_limited),
      cmocka_unit_test(jobs_tell_progress_and_cancel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
