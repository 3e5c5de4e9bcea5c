/* SPDX-License-Identifier: Apache-2.0
 * msq_host_field_def_init, msq_field_host. */
#include "hosts.h"

/* What msq_field_gradient from `from` to `to` gives, operation by operation. */
typedef struct ramp {
  host_log log;
  double from_value, to_value;
  const msq_model* other; /* asked on the way, if there is one */
} ramp;

static const double from[3] = {0.5, 0, 0.25}, to[3] = {3.5, 1, 0};

static double ramp_at(const ramp* r, const double* p) {
  double dot = 0, squared = 0;
  const double d[3] = {p[0] - from[0], p[1] - from[1], p[2] - from[2]};
  const double a[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  dot = d[0] * a[0] + d[1] * a[1] + d[2] * a[2];
  squared = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const double t = dot / squared;
  return t <= 0   ? r->from_value
         : t >= 1 ? r->to_value
                  : r->from_value + t * (r->to_value - r->from_value);
}

static int32_t evaluate(void* user, const double* points, uint64_t count, double* values) {
  ramp* r = (ramp*)user;
  const int32_t code = note_call(&r->log, count);
  if (code && !r->log.bad) return code;
  for (uint64_t i = 0; i < count; ++i) values[i] = ramp_at(r, points + 3 * i);
  if (is_bad_call(&r->log)) values[count - 1] = r->log.code ? NAN : 1e300;
  if (r->other) {
    int32_t inside;
    if (msq_point_membership(r->other, points, NULL, &inside) != MSQ_OK) r->log.wrong = "model";
  }
  return 0;
}

static int32_t range(void* user, const double min[3], const double max[3], double* low,
                     double* high) {
  ramp* r = (ramp*)user;
  const double margin = 1e-9;
  *low = INFINITY;
  *high = -INFINITY;
  if (note_call(&r->log, 1) && !r->log.bad) return r->log.code;
  for (int corner = 0; corner < 8; ++corner) {
    const double p[3] = {corner & 1 ? max[0] : min[0], corner & 2 ? max[1] : min[1],
                         corner & 4 ? max[2] : min[2]};
    *low = fmin(*low, ramp_at(r, p) - margin);
    *high = fmax(*high, ramp_at(r, p) + margin);
  }
  if (is_bad_call(&r->log)) *low = NAN;
  return 0;
}

static ramp make_ramp(double from_value, double to_value) {
  ramp r;
  memset(&r, 0, sizeof r);
  r.log = make_log();
  r.from_value = from_value;
  r.to_value = to_value;
  return r;
}

static msq_host_field_def ramp_def(ramp* r) {
  msq_host_field_def def;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  def.evaluate = evaluate;
  def.user = r;
  def.release = note_release;
  def.low = fmin(r->from_value, r->to_value);
  def.high = fmax(r->from_value, r->to_value);
  return def;
}

static msq_field* make_field(msq_context* context, const msq_host_field_def* def) {
  msq_field* field;
  assert_ok(msq_field_host(context, def, &field));
  return field;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_host_field_def def;
  (void)state;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  assert_int_equal(def.concurrent, 0);
  assert_true(def.evaluate == NULL && def.range == NULL && def.release == NULL);
  assert_null(def.user);
  assert_true(isnan(def.low) && isnan(def.high));
  assert_true(isinf(def.lipschitz) && def.lipschitz > 0);
}

/* ---- what is built with a field of the host is what it is with msq's own */

enum {
  radius_of_lattice,
  radius_of_turned_lattice,
  choice_of_lattice,
  radius_of_foam,
  density_of_foam,
  level_of_function,
  mapped_level,
  thickness_of_walls,
  uses
};

/* Takes over one reference of the field. */
static msq_structure* make_with(msq_context* context, int use, msq_field* field) {
  msq_structure* structure;
  if (use == mapped_level) {
    const double curve[2][2] = {{0.05, 0.05}, {0.3, 0.3}};
    msq_field* mapped;
    assert_ok(msq_field_map(context, field, curve[0], 2, &mapped));
    msq_field_release(field);
    field = mapped;
  }
  if (use == radius_of_lattice || use == radius_of_turned_lattice || use == choice_of_lattice) {
    msq_lattice_def def;
    msq_unit_cell_def library[2];
    assert_ok(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell = MSQ_UNIT_CELL_CUBIC;
    def.radius.value = 0.1;
    if (use == choice_of_lattice) {
      for (int i = 0; i < 2; ++i) {
        assert_ok(msq_unit_cell_def_init(&library[i], sizeof library[i]));
        library[i].unit_cell = i ? MSQ_UNIT_CELL_CUBIC : MSQ_UNIT_CELL_BCC;
      }
      def.cells = library;
      def.cell_count = 2;
      def.cell_choice.field = field;
    } else {
      def.radius.field = field;
    }
    if (use == radius_of_turned_lattice) {
      const double turn[9] = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
      memcpy(def.grid.rotation, turn, sizeof turn);
    }
    assert_ok(msq_structure_lattice(context, &def, &structure));
  } else if (use == level_of_function || use == mapped_level || use == thickness_of_walls) {
    msq_functional_def def;
    assert_ok(msq_functional_def_init(&def, sizeof def));
    if (use == thickness_of_walls) {
      def.kind = MSQ_FUNCTIONAL_SHEET;
      def.thickness.field = field;
    } else {
      def.level.field = field;
    }
    assert_ok(msq_structure_functional(context, &def, &structure));
  } else {
    msq_foam_def def;
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.radius.value = 0.08;
    if (use == radius_of_foam)
      def.radius.field = field;
    else
      def.density.field = field;
    assert_ok(msq_structure_foam(context, &def, &structure));
  }
  msq_field_release(field);
  return structure;
}

static double low_of(int use) {
  return use == density_of_foam ? 1 : use == choice_of_lattice ? -0.2 : 0.05;
}
static double high_of(int use) {
  return use == density_of_foam ? 12 : use == choice_of_lattice ? 1.3 : 0.3;
}

/* Takes over one reference of the field. */
static msq_model* make_model_with(msq_context* context, int use, msq_field* field) {
  return make_model(context, make_box(context), make_with(context, use, field), NULL);
}

static void structures_are_those_of_the_same_field(void** state) {
  (void)state;
  for (int use = 0; use < uses; ++use)
    for (int known = 0; known < 4; known += use ? 3 : 1) { /* bit 0: range, bit 1: lipschitz */
      msq_context* context = make_context();
      ramp r = make_ramp(low_of(use), high_of(use));
      msq_host_field_def def = ramp_def(&r);
      msq_field* same;
      assert_ok(msq_field_gradient(context, from, r.from_value, to, r.to_value, &same));
      if (known & 1) def.range = range;
      if (known & 2) def.lipschitz = (r.to_value - r.from_value) / 3.1;
      msq_model* model = make_model_with(context, use, make_field(context, &def));
      msq_model* expected = make_model_with(context, use, same);
      const uint64_t inside = assert_same_solid(model, expected, 0.013, 3.97);
      assert_in_range(inside, host_samples / 100, host_samples - host_samples / 100);
      assert_right(&r.log);
      assert_true(r.log.calls > 0);
      msq_model_release(expected);
      msq_context_release(context);
      assert_int_equal(r.log.released, 0);
      msq_model_release(model);
      assert_int_equal(r.log.released, 1);
    }
}

static void only_the_calling_thread_is_asked(void** state) {
  (void)state;
  for (int use = 0; use < uses; ++use) {
    msq_context* context = make_context();
    ramp r = make_ramp(low_of(use), high_of(use));
    const msq_host_field_def def = ramp_def(&r);
    msq_model* model = make_model_with(context, use, make_field(context, &def));
    assert_asked_by_caller_alone(model, &r.log);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static int32_t evaluate_anywhere(void* user, const double* points, uint64_t count, double* values) {
  for (uint64_t i = 0; i < count; ++i) values[i] = ramp_at((const ramp*)user, points + 3 * i);
  return 0;
}

static void concurrent_fields_give_the_same(void** state) {
  (void)state;
  for (int use = 0; use < uses; ++use) {
    msq_context* context = make_context();
    ramp r = make_ramp(low_of(use), high_of(use));
    msq_host_field_def def = ramp_def(&r);
    msq_field* same;
    assert_ok(msq_field_gradient(context, from, r.from_value, to, r.to_value, &same));
    def.evaluate = evaluate_anywhere;
    def.concurrent = 1;
    msq_model* model = make_model_with(context, use, make_field(context, &def));
    msq_model* expected = make_model_with(context, use, same);
    assert_same_solid(model, expected, 0.013, 3.97);
    msq_model_release(expected);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* Sets are computed in vectors where the function is, and ask for values in batches. */
static void functional_structures_ask_in_batches(void** state) {
  static uint8_t inside[host_samples];
  static double points[host_samples][3];
  msq_context* context = make_context();
  ramp r = make_ramp(0.05, 0.3);
  const msq_host_field_def def = ramp_def(&r);
  msq_model* model = make_model_with(context, level_of_function, make_field(context, &def));
  msq_points_def array;
  (void)state;
  memset(points, 0, sizeof points);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = host_samples;
  assert_ok(msq_set_membership(model, &array, NULL, inside, host_samples, NULL));
  assert_int_equal(r.log.points, host_samples);
  assert_in_range(r.log.calls, 1, host_samples / 100);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- what goes wrong */

static msq_status ask_everything(const msq_model* model) {
  static uint8_t inside[host_samples / 8];
  static double distance[host_samples / 8];
  msq_points_def grid = host_grid(0.01, 3.99);
  for (int axis = 0; axis < 3; ++axis) { /* fewer samples: distances are dear */
    grid.counts[axis] = host_side / 2;
    grid.spacing[axis] *= 2;
  }
  const double point[3] = {1.2, 1.3, 1.4};
  int32_t one;
  double d;
  msq_status status = msq_point_membership(model, point, NULL, &one);
  if (status == MSQ_OK) status = msq_point_distance(model, point, NULL, &d);
  if (status == MSQ_OK)
    status = msq_set_membership(model, &grid, NULL, inside, host_samples / 8, NULL);
  if (status == MSQ_OK)
    status = msq_set_distance(model, &grid, NULL, distance, host_samples / 8, NULL);
  return status;
}

static void callbacks_that_fail_stop_the_call(void** state) {
  (void)state;
  for (int use = 0; use < uses; ++use)
    for (int bad = 0; bad < 3; ++bad) { /* 1: too large, 2: no number */
      uint64_t calls = 0;
      for (int attempt = 0; attempt < 5; ++attempt) {
        if (test_scale() < 0.5 && attempt && attempt != bad + 2) continue;
        msq_context* context = make_context();
        ramp r = make_ramp(low_of(use), high_of(use));
        msq_host_field_def def = ramp_def(&r);
        def.range = range;
        r.log.bad = bad > 0;
        r.log.code = bad == 1 ? 0 : -4711;
        msq_model* model = make_model_with(context, use, make_field(context, &def));
        if (attempt) {
          r.log.fail_at = 1 + (calls - 1) * (uint64_t)(attempt - 1) / 3;
          assert_refused(ask_everything(model), MSQ_E_HOST, bad ? "the host's field" : "returned");
          assert_int_equal(msq_error_host_code(), bad ? 0 : -4711);
          assert_int_equal(r.log.calls, r.log.fail_at);
        }
        assert_ok(ask_everything(model));
        if (!attempt) calls = r.log.calls;
        msq_model_release(model);
        msq_context_release(context);
        assert_int_equal(r.log.released, 1);
      }
    }
}

static int32_t fail_anywhere(void* user, const double* points, uint64_t count, double* values) {
  (void)user, (void)points, (void)count, (void)values;
  return 42;
}

/* Ranges that the values keep to nowhere near: some answers are wrong, and no more. */
static int32_t false_range(void* user, const double min[3], const double max[3], double* low,
                           double* high) {
  const ramp* r = (const ramp*)user;
  (void)min, (void)max;
  *low = *high = r->log.bad ? fmax(r->from_value, r->to_value) : fmin(r->from_value, r->to_value);
  return 0;
}

static void promises_that_are_broken_do_no_harm(void** state) {
  (void)state;
  for (int use = 0; use < uses; ++use)
    /* A range, low or high, a Lipschitz constant, and both, which contradict each other. */
    for (int lie = 0; lie < 5; ++lie) {
      msq_context* context = make_context();
      ramp r = make_ramp(low_of(use), high_of(use));
      msq_host_field_def def = ramp_def(&r);
      r.log.bad = lie % 2;
      if (lie != 4) def.range = false_range;
      if (lie >= 2) def.lipschitz = 0;
      r.log.fail_at = UINT64_MAX;
      msq_model* model = make_model_with(context, use, make_field(context, &def));
      assert_ok(ask_everything(model));
      msq_model_release(model);
      msq_context_release(context);
    }
}

static void codes_come_back_from_worker_threads(void** state) {
  msq_context* context = make_context();
  ramp r = make_ramp(0.05, 0.3);
  msq_host_field_def def = ramp_def(&r);
  (void)state;
  def.evaluate = fail_anywhere;
  def.concurrent = 1;
  msq_model* model = make_model_with(context, level_of_function, make_field(context, &def));
  static uint8_t inside[host_samples];
  const msq_points_def grid = host_grid(0.01, 3.99);
  assert_refused(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL), MSQ_E_HOST,
                 "evaluate returned 42");
  assert_int_equal(msq_error_host_code(), 42);
  msq_model_release(model);
  msq_context_release(context);
}

/* A callback may ask another model, even one whose work is the same. */
static void callbacks_may_call_msq(void** state) {
  msq_context* context = make_context();
  ramp r = make_ramp(1, 12), other = make_ramp(3, 9);
  const msq_host_field_def def = ramp_def(&r), other_def = ramp_def(&other);
  msq_field* same;
  (void)state;
  assert_ok(msq_field_gradient(context, from, 1, to, 12, &same));
  msq_model* asked = make_model_with(context, density_of_foam, make_field(context, &other_def));
  msq_model* model = make_model_with(context, density_of_foam, make_field(context, &def));
  msq_model* expected = make_model_with(context, density_of_foam, same);
  r.other = asked;
  assert_same_solid(model, expected, 1.013, 1.97);
  assert_right(&r.log);
  assert_right(&other.log);
  assert_true(other.log.calls > 0);
  msq_model_release(expected);
  msq_model_release(model);
  msq_model_release(asked);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(structures_are_those_of_the_same_field),
      cmocka_unit_test(only_the_calling_thread_is_asked),
      cmocka_unit_test(concurrent_fields_give_the_same),
      cmocka_unit_test(functional_structures_ask_in_batches),
      cmocka_unit_test(callbacks_that_fail_stop_the_call),
      cmocka_unit_test(promises_that_are_broken_do_no_harm),
      cmocka_unit_test(codes_come_back_from_worker_threads),
      cmocka_unit_test(callbacks_may_call_msq),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
