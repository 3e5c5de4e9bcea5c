/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_distance_field_def_init, msq_field_shape_distance. */
#include "fields.h"

DEFINE_INIT(shape_distance_field_def)

static const double curve[] = {-1, 10, 0, 20, 2, 40};

static msq_shape_distance_field_def distance_def(const msq_shape* shape) {
  msq_shape_distance_field_def def;
  assert_ok(msq_shape_distance_field_def_init(&def, sizeof def));
  def.shape = shape;
  def.curve = curve;
  def.curve_count = 3;
  return def;
}

static msq_status create(void* env, void* def) {
  msq_field* made = (msq_field*)untouched();
  const msq_status status = msq_field_shape_distance(
      (msq_context*)env, (const msq_shape_distance_field_def*)def, &made, NULL);
  if (status == MSQ_OK)
    msq_field_release(made);
  else
    assert_ptr_equal(made, untouched());
  return status;
}

static void def_init_honours_every_size(void** state) {
  (void)state;
  check_def_init(init_shape_distance_field_def, sizeof(msq_shape_distance_field_def));
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_box(context);
  const msq_shape_distance_field_def def = distance_def(shape);
  (void)state;
  check_def_sizes(&def, sizeof def, create, context);
  msq_shape_release(shape);
  msq_context_release(context);
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

static void bad_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = make_box(context);
  msq_shape_distance_field_def def = distance_def(shape);
  (void)state;
  assert_makes_nothing(msq_field, msq_field_shape_distance(NULL, &def, &made, NULL), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_field, msq_field_shape_distance(context, NULL, &made, NULL),
                       MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(msq_field_shape_distance(context, &def, NULL, NULL), MSQ_E_ARGUMENT,
                 "field is NULL");
  def.reserved = 3;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "reserved is 3");
  def = distance_def(NULL);
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "shape is NULL");
  def = distance_def(shape);
  def.curve = NULL;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "curve is NULL");
  def.curve_count = 0;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "curve_count is 0");
  const double repeated[4] = {1, 0, 1, 2}, falling[4] = {1, 0, 0.5, 2};
  def.curve_count = 2;
  def.curve = repeated;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "ascend");
  def.curve = falling;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "0.5");
  for (int which = 0; which < 3; ++which) {
    def = distance_def(shape);
    def.step = not_finite(which);
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "step");
  }
  def.step = -1;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "step is -1");
  def.step = 1e-9;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "1048576");
  msq_shape_release(shape);
  msq_context* small = make_context_of(1, 0, 100000);
  shape = make_box(small);
  def = distance_def(shape);
  def.step = 0.01;
  assert_refused(create(small, &def), MSQ_E_LIMIT, "samples of a distance");
  msq_shape_release(shape);
  msq_context_release(small);
  msq_context_release(context);
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
      cmocka_unit_test(def_init_honours_every_size),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(field_is_the_curve_over_the_distance),
      cmocka_unit_test(bad_arguments_are_refused),
      cmocka_unit_test(job_cancels_and_tells_the_progress),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
