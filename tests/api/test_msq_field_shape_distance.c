/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_distance_field_def_init, msq_field_shape_distance. */
#include "fields.h"

static const double curve[] = {-1, 10, 0, 20, 2, 40};

static msq_shape_distance_field_def distance_def(const msq_shape* shape) {
  msq_shape_distance_field_def def;
  assert_ok(msq_shape_distance_field_def_init(&def, sizeof def));
  def.shape = shape;
  def.curve = curve;
  def.curve_count = 3;
  return def;
}

/* The shape is the cube from 0 to 4, as a box and as a mesh, exact and sampled. */
static void field_is_the_curve_over_the_distance(void** state) {
  (void)state;
  for (int is_mesh = 0; is_mesh < 2; ++is_mesh)
    for (int is_sampled = 0; is_sampled < 2; ++is_sampled) {
      msq_context* context = make_context();
      msq_shape* shape = is_mesh ? make_cube_mesh(context) : make_box(context);
      msq_shape_distance_field_def def = distance_def(shape);
      msq_field* field;
      if (is_sampled) def.step = 0.25;
      assert_ok(msq_field_shape_distance(context, &def, &field, NULL));
      msq_shape_release(shape); /* the field keeps it */
      assert_near(field_at(context, field, 2, 2, 2), 10, 1e-5);
      assert_near(field_at(context, field, 0.5, 2, 2), 15, 1e-5);
      assert_near(field_at(context, field, 2, 2, 4), 20, 1e-5);
      if (!is_sampled) assert_near(field_at(context, field, 2, 5, 2), 30, 1e-5);
      if (!is_sampled) assert_near(field_at(context, field, 2, 9, 2), 40, 1e-5);
      msq_field_release(field);
      assert_int_equal(memory_of(context).bytes, 0);
      msq_context_release(context);
    }
}

typedef struct cancelling {
  msq_job* job;
  int calls;
} cancelling;

static int32_t all_inside(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)user;
  (void)points;
  memset(inside, 1, (size_t)count);
  return 0;
}

/* Cancels the job of the call that it is part of. */
static int32_t distance_until_cancelled(void* user, const double* points, uint64_t count,
                                        double* values) {
  cancelling* c = (cancelling*)user;
  (void)points;
  memset(values, 0, (size_t)count * sizeof *values);
  if (++c->calls == 5) assert_ok(msq_job_cancel(c->job));
  return 0;
}

/* Of a ball so small that floats do not hold the distances between samples. */
static void tiny_steps_are_refused(void** state) {
  static const double center[3] = {0, 0, 0};
  msq_context* context = make_context();
  msq_shape* ball;
  msq_shape_distance_field_def def;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 1e-39, &ball));
  def = distance_def(ball);
  def.step = 1e-40;
  assert_makes_nothing(msq_field, msq_field_shape_distance(context, &def, &made, NULL),
                       MSQ_E_ARGUMENT, "step is 1e-40; it must be at least 1.17549e-38");
  msq_shape_release(ball);
  msq_context_release(context);
}

static void job_cancels_and_tells_the_progress(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_cube_mesh(context);
  msq_shape_distance_field_def def = distance_def(shape);
  msq_host_shape_def host;
  cancelling user = {NULL, 0};
  msq_field* field;
  double progress = 0;
  (void)state;
  for (int is_sampled = 0; is_sampled < 2; ++is_sampled) {
    if (is_sampled) def.step = 0.25;
    assert_ok(msq_job_create(&user.job));
    assert_ok(msq_field_shape_distance(context, &def, &field, user.job));
    assert_ok(msq_job_progress(user.job, &progress));
    assert_true(progress == 1);
    msq_field_release(field);
    assert_ok(msq_job_cancel(user.job));
    assert_makes_nothing(msq_field, msq_field_shape_distance(context, &def, &made, user.job),
                         MSQ_E_CANCELLED, "cancelled");
    msq_job_release(user.job);
  }
  msq_shape_release(shape);
  assert_ok(msq_host_shape_def_init(&host, sizeof host));
  host.inside = all_inside;
  host.distance = distance_until_cancelled;
  host.user = &user;
  for (int axis = 0; axis < 3; ++axis) {
    host.min[axis] = 0;
    host.max[axis] = 1;
  }
  assert_ok(msq_shape_from_host(context, &host, &shape));
  def.shape = shape;
  assert_ok(msq_job_create(&user.job));
  assert_makes_nothing(msq_field, msq_field_shape_distance(context, &def, &made, user.job),
                       MSQ_E_CANCELLED, "cancelled");
  assert_int_equal(user.calls, 5);
  msq_job_release(user.job);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(field_is_the_curve_over_the_distance),
      cmocka_unit_test(tiny_steps_are_refused),
      cmocka_unit_test(job_cancels_and_tells_the_progress),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
