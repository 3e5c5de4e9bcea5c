/* SPDX-License-Identifier: Apache-2.0
 * msq_host_shape_def_init, msq_shape_from_host. */
#include "hosts.h"

static const double centre[3] = {2, 1.75, 2.25};
static const double radius = 1.5;

static double squared_from_centre(const double* p) {
  const double d[3] = {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

static int32_t inside_ball(void* user, const double* points, uint64_t count, uint8_t* inside) {
  host_log* log = (host_log*)user;
  const int32_t code = note_call(log, count);
  if (code) return code;
  for (uint64_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(fabs(points[3 * i + axis] - centre[axis]) <= radius)) log->wrong = "point";
    /* 0 is there already */
    if (squared_from_centre(points + 3 * i) <= radius * radius) inside[i] = i % 2 ? 1 : 255;
  }
  return 0;
}

/* Half of the signed distance: a bound of either sign. */
static int32_t bound_of_ball(void* user, const double* points, uint64_t count, double* values) {
  host_log* log = (host_log*)user;
  const int32_t code = note_call(log, count);
  if (code) return code;
  for (uint64_t i = 0; i < count; ++i)
    values[i] = 0.5 * (sqrt(squared_from_centre(points + 3 * i)) - radius);
  if (log->bad) values[0] = NAN;
  return 0;
}

static msq_host_shape_def ball_def(host_log* log) {
  msq_host_shape_def def;
  assert_ok(msq_host_shape_def_init(&def, sizeof def));
  def.inside = inside_ball;
  def.user = log;
  def.release = note_release;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = centre[axis] - radius;
    def.max[axis] = centre[axis] + radius;
  }
  return def;
}

static msq_shape* make_ball(msq_context* context, const msq_host_shape_def* def) {
  msq_shape* shape;
  assert_ok(msq_shape_from_host(context, def, &shape));
  return shape;
}

static msq_shape* make_own_ball(msq_context* context) {
  msq_shape* shape;
  assert_ok(msq_shape_from_sphere(context, centre, radius, &shape));
  return shape;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_host_shape_def def;
  (void)state;
  assert_ok(msq_host_shape_def_init(&def, sizeof def));
  assert_int_equal(def.concurrent, 0);
  assert_true(def.inside == NULL && def.distance == NULL && def.release == NULL);
  assert_null(def.user);
  for (int axis = 0; axis < 3; ++axis) assert_true(isnan(def.min[axis]) && isnan(def.max[axis]));
}

static void a_ball_is_a_ball(void** state) {
  (void)state;
  for (int filled = 0; filled < 2; ++filled) {
    msq_context* context = make_context();
    host_log log = make_log();
    const msq_host_shape_def def = ball_def(&log);
    msq_model* model =
        make_model(context, make_ball(context, &def), filled ? make_lattice(context) : NULL, NULL);
    msq_model* own =
        make_model(context, make_own_ball(context), filled ? make_lattice(context) : NULL, NULL);
    const uint64_t inside = assert_same_solid(model, own, 0, 4);
    assert_in_range(inside, host_samples / 100, host_samples / 3);
    assert_asked_by_caller_alone(model, &log);
    assert_right(&log);
    msq_model_release(own);
    msq_context_release(context);
    assert_int_equal(log.released, 0);
    msq_model_release(model);
    assert_int_equal(log.released, 1);
  }
}

static void sets_ask_in_batches(void** state) {
  static uint8_t inside[host_samples];
  static double points[host_samples][3];
  msq_context* context = make_context();
  host_log log = make_log();
  const msq_host_shape_def def = ball_def(&log);
  msq_model* model = make_shape_model(context, make_ball(context, &def));
  const msq_points_def grid = host_grid(0.6, 3.2);
  msq_points_def array;
  (void)state;
  for (int i = 0; i < host_samples; ++i) memcpy(points[i], centre, sizeof centre);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = host_samples;
  assert_ok(msq_set_membership(model, &array, NULL, inside, host_samples, NULL));
  assert_filled(inside, host_samples, 1);
  assert_int_equal(log.points, host_samples);
  assert_int_equal(log.calls, (host_samples + 4095) / 4096);
  log.calls = 0;
  assert_ok(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL));
  assert_in_range(log.calls, 1, host_side);
  assert_right(&log);
  msq_model_release(model);
  msq_context_release(context);
}

/* Rays from all around, within a finer structure, too: callbacks for all at once, not for each.
 */
static void rays_ask_in_batches(void** state) {
  enum { count = 1000 };
  static double origins[count][3], directions[count][3];
  static msq_ray_hit hits[count], wanted[count];
  (void)state;
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      origins[i][axis] = centre[axis] + 4 * cos(0.7 * i + axis * 1.9);
      directions[i][axis] = centre[axis] - origins[i][axis] + 1.2 * cos(1.3 * i + axis);
    }
  for (int has_distance = 0; has_distance < 2; ++has_distance)
    for (int has_lattice = 0; has_lattice < 2; ++has_lattice) {
      msq_context* context = make_context();
      host_log log = make_log();
      msq_host_shape_def def = ball_def(&log);
      def.distance = has_distance ? bound_of_ball : NULL;
      msq_model* model = make_model(context, make_ball(context, &def),
                                    has_lattice ? make_lattice(context) : NULL, NULL);
      msq_model* own = make_model(context, make_own_ball(context),
                                  has_lattice ? make_lattice(context) : NULL, NULL);
      msq_rays_def rays;
      assert_ok(msq_rays_def_init(&rays, sizeof rays));
      rays.count = count;
      rays.origins = origins;
      rays.directions = directions;
      assert_ok(msq_ray_cast(own, &rays, NULL, wanted, count, NULL));
      log.calls = log.points = 0;
      assert_ok(msq_ray_cast(model, &rays, NULL, hits, count, NULL));
      int same = 0, hit = 0;
      for (int i = 0; i < count; ++i) {
        hit += wanted[i].scale >= 0;
        same += hits[i].scale == wanted[i].scale &&
                (hits[i].scale < 0 || fabs(hits[i].t - wanted[i].t) < 1e-9);
      }
      assert_true(hit > count / 2);
      /* Thin slices of the ball may be lost without a distance. */
      assert_true(has_distance ? same == count : same > count * 98 / 100);
      assert_in_range(log.points, 10 * count, 2000 * count);
      /* In and out by steps of 1/1024 without a distance. */
      assert_in_range(log.calls, 1, has_distance ? 2000 : 6000);
      assert_right(&log);
      msq_model_release(own);
      msq_model_release(model);
      msq_context_release(context);
    }
}

static void distances_are_bounds_with_the_sign_of_membership(void** state) {
  const double tips[3] = {centre[0] + 3 * radius, centre[1] + 0.5, centre[2] - 2 * radius};
  (void)state;
  for (int known = 0; known < 2; ++known) {
    msq_context* context = make_context();
    host_log log = make_log();
    msq_host_shape_def def = ball_def(&log);
    if (known) def.distance = bound_of_ball;
    msq_model* model = make_shape_model(context, make_ball(context, &def));
    uint64_t seed = 3;
    double d;
    for (int i = 0; i < 2000; ++i) {
      double p[3];
      for (int axis = 0; axis < 3; ++axis) p[axis] = random_between(&seed, -1, 5);
      const double exact = sqrt(squared_from_centre(p)) - radius;
      assert_ok(msq_point_distance(model, p, NULL, &d));
      assert_true(fabs(d) <= fabs(exact) * (1 + 1e-12) + 1e-300);
      assert_int_equal(d <= 0, exact <= 0);
      if (known) assert_true(fabs(d) >= 0.499 * fabs(exact));
    }
    /* outside the box, at least that of the box */
    assert_ok(msq_point_distance(model, tips, NULL, &d));
    assert_near(d, sqrt(5) * radius, 1e-9);
    assert_right(&log);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* A field that samples the distance asks for it when it is made. */
static void fields_of_its_distance_ask_the_calling_thread(void** state) {
  const double curve[2] = {0, 1};
  msq_context* context = make_context();
  host_log log = make_log();
  const msq_host_shape_def def = ball_def(&log);
  msq_shape* shape = make_ball(context, &def);
  msq_shape_distance_field_def field_def;
  msq_field* field;
  (void)state;
  assert_ok(msq_shape_distance_field_def_init(&field_def, sizeof field_def));
  field_def.shape = shape;
  field_def.curve = curve;
  field_def.curve_count = 1;
  field_def.step = 0.1;
  log.rests = 1;
  assert_ok(msq_field_shape_distance(context, &field_def, &field, NULL));
  assert_true(log.calls > 1000);
  assert_right(&log);
  log.calls = 0;
  log.fail_at = 500;
  log.code = 3;
  assert_refused(msq_field_shape_distance(context, &field_def, &field, NULL), MSQ_E_HOST,
                 "returned 3");
  msq_field_release(field);
  msq_shape_release(shape);
  msq_context_release(context);
  assert_int_equal(log.released, 1);
}

static void volume_and_area_are_not_known(void** state) {
  msq_context* context = make_context();
  host_log log = make_log();
  const msq_host_shape_def def = ball_def(&log);
  msq_shape* shape = make_ball(context, &def);
  const msq_shape_report report = info_of(shape);
  (void)state;
  assert_int_equal(report.is_mesh, 0);
  assert_true(isnan(report.volume) && isnan(report.area));
  assert_true(report.min[1] == centre[1] - radius && report.max[2] == centre[2] + radius);
  assert_int_equal(report.triangles, 0);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void callbacks_that_fail_stop_the_call(void** state) {
  static uint8_t inside[host_samples];
  static double distance[host_samples];
  const msq_points_def grid = host_grid(0.6, 3.2);
  msq_context* context = make_context();
  host_log log = make_log();
  msq_host_shape_def def = ball_def(&log);
  def.distance = bound_of_ball;
  msq_model* model = make_shape_model(context, make_ball(context, &def));
  (void)state;
  log.fail_at = 2;
  log.code = 9;
  assert_refused(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL), MSQ_E_HOST,
                 "inside returned 9");
  assert_int_equal(msq_error_host_code(), 9);
  assert_int_equal(log.calls, 2);
  log.calls = 0;
  assert_refused(msq_set_distance(model, &grid, NULL, distance, host_samples, NULL), MSQ_E_HOST,
                 "returned 9");
  log.fail_at = 0;
  log.bad = 1;
  assert_refused(msq_point_distance(model, centre, NULL, distance), MSQ_E_HOST, "nan");
  assert_int_equal(msq_error_host_code(), 0);
  msq_model_release(model);
  msq_context_release(context);
  assert_int_equal(log.released, 1);
}

/* ---- callbacks that let go of what the call works with */

typedef struct farewell {
  msq_model* model;
  msq_job* job;
} farewell;

static int32_t inside_after_farewell(void* user, const double* points, uint64_t count,
                                     uint8_t* inside) {
  farewell* last = (farewell*)user;
  (void)points;
  if (last->model) {
    msq_model_release(last->model);
    msq_job_release(last->job);
    last->model = NULL;
  }
  memset(inside, 1, count);
  return 0;
}

enum { ask_set, ask_rays, ask_statistic, ask_ways };

static msq_status ask_under_job(const msq_model* model, msq_job* job, int way) {
  static uint8_t inside[125];
  const double origin[3] = {-1, 2.1, 2.1}, direction[3] = {1, 0, 0};
  msq_points_def points = grid_points(0.1, 3.9, 5);
  if (way == ask_set) return msq_set_membership(model, &points, NULL, inside, 125, job);
  if (way == ask_rays) {
    msq_rays_def rays;
    msq_ray_hit hit;
    assert_ok(msq_rays_def_init(&rays, sizeof rays));
    rays.origins = origin;
    rays.directions = direction;
    rays.count = 1;
    return msq_ray_cast(model, &rays, NULL, &hit, 1, job);
  }
  msq_estimate estimate;
  points.kind = MSQ_POINTS_STRATIFIED;
  points.per_cell = 2;
  return msq_volume_fraction(model, &points, NULL, MSQ_PHASE_SOLID, &estimate, job);
}

static void callbacks_may_let_go_of_the_model_and_the_job(void** state) {
  (void)state;
  for (int way = 0; way < ask_ways; ++way) {
    msq_context* context = make_context();
    farewell last;
    msq_host_shape_def def;
    assert_ok(msq_host_shape_def_init(&def, sizeof def));
    def.inside = inside_after_farewell;
    def.user = &last;
    for (int axis = 0; axis < 3; ++axis) {
      def.min[axis] = 0;
      def.max[axis] = 4;
    }
    last.model = make_shape_model(context, make_ball(context, &def));
    assert_ok(msq_job_create(&last.job));
    assert_ok(ask_under_job(last.model, last.job, way));
    assert_null(last.model);
    msq_context_release(context);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(a_ball_is_a_ball),
      cmocka_unit_test(sets_ask_in_batches),
      cmocka_unit_test(rays_ask_in_batches),
      cmocka_unit_test(distances_are_bounds_with_the_sign_of_membership),
      cmocka_unit_test(fields_of_its_distance_ask_the_calling_thread),
      cmocka_unit_test(volume_and_area_are_not_known),
      cmocka_unit_test(callbacks_that_fail_stop_the_call),
      cmocka_unit_test(callbacks_may_let_go_of_the_model_and_the_job),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
