/* SPDX-License-Identifier: Apache-2.0
 * msq_host_function_def_init, msq_structure_host_function. */
#include "hosts.h"

#include "fills.h"

static double schwarz_p(const double* a) {
  return cos(a[0]) + cos(a[1]) + cos(a[2]);
}

static int32_t evaluate(void* user, const double* angles, uint64_t count, double* values) {
  host_log* log = (host_log*)user;
  const int32_t code = note_call(log, count);
  if (code && !log->bad) return code;
  for (uint64_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(angles[3 * i + axis] >= -1e-9 && angles[3 * i + axis] <= 6.2831853072 + 1e-9))
        log->wrong = "angle";
    values[i] = schwarz_p(angles + 3 * i);
  }
  if (is_bad_call(log)) values[0] = NAN;
  return 0;
}

/* By the Lipschitz constants of the terms. */
static int32_t range(void* user, const double min[3], const double max[3], double* low,
                     double* high) {
  host_log* log = (host_log*)user;
  const int32_t code = note_call(log, 1);
  double middle[3], off = 0;
  if (code && !log->bad) return code;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(min[axis] >= -1e-9 && min[axis] < max[axis] && max[axis] <= 6.2831853072 + 1e-9))
      log->wrong = "box";
    middle[axis] = (min[axis] + max[axis]) / 2;
    off += (max[axis] - min[axis]) / 2;
  }
  *low = schwarz_p(middle) - off;
  *high = is_bad_call(log) ? *low - 1 : schwarz_p(middle) + off;
  return 0;
}

static msq_host_function_def function_def(host_log* log, double level) {
  msq_host_function_def def;
  assert_ok(msq_host_function_def_init(&def, sizeof def));
  def.evaluate = evaluate;
  def.user = log;
  def.release = note_release;
  def.level.value = level;
  return def;
}

static msq_model* fill_box(msq_context* context, const msq_host_function_def* def) {
  msq_structure* structure;
  assert_ok(msq_structure_host_function(context, def, &structure));
  return make_model(context, make_box(context), structure, NULL);
}

DEFINE_CREATE(structure, structure_host_function, host_function_def)

static void defaults_are_those_of_the_header(void** state) {
  msq_host_function_def def;
  msq_functional_def own;
  (void)state;
  assert_ok(msq_host_function_def_init(&def, sizeof def));
  assert_ok(msq_functional_def_init(&own, sizeof own));
  assert_memory_equal(&def.grid, &own.grid, sizeof def.grid);
  assert_int_equal(def.kind, MSQ_FUNCTIONAL_NETWORK);
  assert_int_equal(def.clusters, 0);
  assert_int_equal(def.concurrent, 0);
  assert_true(def.level.value == 0 && !def.level.field);
  assert_true(!def.evaluate && !def.range && !def.user && !def.release);
  assert_true(isinf(def.lipschitz) && def.lipschitz > 0);
}

/* Against msq's own, whose functions are not the C library's: within rounding of the level, which
 * no sample of these is. */
static void a_function_is_that_function(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 1, 0};
  (void)state;
  for (int kind = MSQ_FUNCTIONAL_NETWORK; kind <= MSQ_FUNCTIONAL_SHEET; ++kind)
    for (int known = 0; known < 4; ++known) /* bit 0: range, bit 1: lipschitz */
      for (int graded = 0; graded < 2; ++graded) {
        msq_context* context = make_context();
        host_log log = make_log();
        msq_host_function_def def = function_def(&log, 0.3);
        msq_functional_def own;
        msq_field* field;
        msq_structure* structure;
        assert_ok(msq_field_gradient(context, from, 0.1, to, 0.9, &field));
        def.kind = kind;
        def.grid.cell_size[1] = 1.25;
        def.grid.origin[0] = -0.3;
        if (known & 1) def.range = range;
        if (known & 2) def.lipschitz = 1.7320509;
        if (known & 1) def.clusters = 9;
        if (graded) def.level.field = field;
        assert_ok(msq_functional_def_init(&own, sizeof own));
        own.function = MSQ_FUNCTION_SCHWARZ_P;
        own.kind = kind;
        own.grid = def.grid;
        own.level = def.level;
        msq_model* model = fill_box(context, &def);
        assert_int_equal(log.points > 0, known > 0);
        assert_ok(msq_structure_functional(context, &own, &structure));
        msq_model* same = make_model(context, make_box(context), structure, NULL);
        msq_field_release(field);
        log.points = 0;
        const uint64_t inside = assert_same_solid(model, same, 0.013, 3.97);
        assert_in_range(inside, host_samples / 10, host_samples - host_samples / 10);
        assert_asked_by_caller_alone(model, &log);
        assert_right(&log);
        msq_model_release(same);
        msq_context_release(context);
        assert_int_equal(log.released, 0);
        msq_model_release(model);
        assert_int_equal(log.released, 1);
      }
}

static void clusters_spare_points(void** state) {
  static uint8_t inside[host_samples];
  const msq_points_def grid = host_grid(0.013, 3.97);
  uint64_t points[2];
  (void)state;
  for (int known = 0; known < 2; ++known) {
    msq_context* context = make_context();
    host_log log = make_log();
    msq_host_function_def def = function_def(&log, 0.3);
    if (known) def.lipschitz = 1.7320509;
    msq_model* model = fill_box(context, &def);
    log.points = 0;
    assert_ok(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL));
    points[known] = log.points;
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_int_equal(points[0], host_samples);
  assert_in_range(points[1], 1, host_samples / 4);
}

static void callbacks_that_fail_stop_the_call(void** state) {
  static uint8_t inside[host_samples];
  const msq_points_def grid = host_grid(0.013, 3.97);
  msq_context* context = make_context();
  host_log log = make_log();
  msq_host_function_def def = function_def(&log, 0.3);
  msq_model* model = fill_box(context, &def);
  (void)state;
  log.fail_at = 3;
  log.code = 12;
  assert_refused(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL), MSQ_E_HOST,
                 "evaluate returned 12");
  assert_int_equal(msq_error_host_code(), 12);
  log.calls = 0;
  log.bad = 1;
  assert_refused(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL), MSQ_E_HOST,
                 "no number");
  assert_int_equal(msq_error_host_code(), 0);
  msq_model_release(model);
  assert_int_equal(log.released, 1);

  /* in the constructor, which then releases nothing */
  for (int bad = 0; bad < 2; ++bad)
    for (int by_range = 0; by_range < 2; ++by_range) {
      log = make_log();
      log.fail_at = 2;
      log.code = 12;
      log.bad = bad;
      def = function_def(&log, 0.3);
      if (by_range)
        def.range = range;
      else
        def.lipschitz = 1.75;
      assert_refused(create(context, &def), MSQ_E_HOST,
                     !bad       ? "returned 12"
                     : by_range ? "runs from"
                                : "no number");
      assert_int_equal(msq_error_host_code(), bad ? 0 : 12);
      assert_int_equal(log.released, 0);
    }
  msq_context_release(context);
}

/* Not even where the slope is known. */
static void distances_are_0_within_the_shape(void** state) {
  msq_context* context = make_context();
  host_log log = make_log();
  msq_host_function_def def = function_def(&log, 0.3);
  const double points[3][3] = {{0.01, 0.02, 0.03}, {0.5, 0.5, 0.5}, {5, 2, 2}};
  double distance;
  (void)state;
  def.range = range;
  def.lipschitz = 1.7320509;
  msq_model* model = fill_box(context, &def);
  assert_ok(msq_point_distance(model, points[0], NULL, &distance));
  assert_true(distance > 0 && distance < 1e-300);
  assert_ok(msq_point_distance(model, points[1], NULL, &distance));
  assert_true(distance == 0);
  assert_ok(msq_point_distance(model, points[2], NULL, &distance));
  assert_near(distance, 1, 1e-12);
  msq_model_release(model);
  msq_context_release(context);
}

/* Lines of walls: calls from the calling thread alone, and failures that come through. */
static void it_has_fill_lines(void** state) {
  msq_context* context = make_context_of(2, 0, 0);
  host_log log = make_log();
  msq_host_function_def def = function_def(&log, 0.3);
  const msq_fill_def square = square_def(1);
  msq_structure* structure;
  msq_fill* made = NULL;
  (void)state;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  set_cell(&def.grid, 5);
  assert_ok(msq_structure_host_function(context, &def, &structure));
  msq_structure* known = make_sheet(context, MSQ_FUNCTION_SCHWARZ_P, 5);
  msq_fill *fill = make_fill(context, structure, &square),
           *other = make_fill(context, known, &square);
  const msq_fill_report paths = paths_of(fill), expected = paths_of(other);
  assert_near(paths.length, expected.length, 1e-6 * expected.length);
  assert_int_equal(paths.path_count, expected.path_count);
  for (int bad = 0; bad < 2; ++bad) {
    log.calls = 0;
    log.fail_at = 7;
    log.code = -12;
    log.bad = bad;
    assert_refused(msq_fill_lines(context, structure, &square, &made, NULL), MSQ_E_HOST,
                   bad ? "no number" : "-12");
    assert_int_equal(msq_error_host_code(), bad ? 0 : -12);
    assert_null(made);
  }
  assert_right(&log);
  msq_fill_release(fill);
  msq_fill_release(other);
  msq_structure_release(known);
  msq_structure_release(structure);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(a_function_is_that_function),
      cmocka_unit_test(clusters_spare_points),
      cmocka_unit_test(callbacks_that_fail_stop_the_call),
      cmocka_unit_test(distances_are_0_within_the_shape),
      cmocka_unit_test(it_has_fill_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
