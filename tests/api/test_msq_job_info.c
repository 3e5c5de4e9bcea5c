/* SPDX-License-Identifier: Apache-2.0
 * msq_job_info: which scale and which method answered the points of a set; with it the choice of
 * the method in msq_query_def. */
#include "definitions.h"

static msq_job_report counts_of(const msq_job* job) {
  msq_job_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_job_info(job, &report));
  return report;
}

enum { count = 6000 };

/* Points in the box of 4 and as many around it. */
static double (*random_points(void))[3] {
  static double points[count][3];
  uint64_t random = 3;
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&random, -0.5, 4.5);
  return points;
}

/* Runs a query and compares its answers with those of single points. */
static msq_job_report ask(const msq_model* model, const msq_points_def* def, uint64_t points,
                          int32_t method, uint64_t critical_count, double length_scale) {
  uint8_t* inside = (uint8_t*)malloc(points);
  double(*at)[3] = (double(*)[3])malloc(points * sizeof *at);
  msq_query_def query;
  msq_job* job;
  assert_non_null(inside);
  assert_non_null(at);
  assert_ok(msq_query_def_init(&query, sizeof query));
  query.method = method;
  query.critical_count = critical_count;
  query.length_scale = length_scale;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_set_membership(model, def, &query, inside, points, job));
  assert_ok(msq_points_generate(def, 0, points, at[0]));
  for (uint64_t i = 0; i < points; ++i) {
    int32_t wanted = -1;
    assert_ok(msq_point_membership(model, at[i], &query, &wanted));
    assert_int_equal(inside[i], wanted);
  }
  const msq_job_report report = counts_of(job);
  msq_job_release(job);
  free(inside);
  free(at);
  return report;
}

static msq_points_def definition(int32_t kind) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = kind;
  def.coordinates = random_points();
  def.count = count;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = -0.5;
    def.spacing[axis] = 0.5;
    def.counts[axis] = 10;
  }
  def.per_cell = 6;
  if (kind == MSQ_POINTS_GRID) {
    const uint64_t counts[3] = {20, 15, 20};
    for (int axis = 0; axis < 3; ++axis) {
      def.spacing[axis] = 5.0 / (double)counts[axis];
      def.counts[axis] = counts[axis];
      def.origin[axis] = -0.51;
    }
  }
  return def;
}

/* A coarse lattice, and a foam within its struts. */
static msq_model* make_three_scales(msq_context* context) {
  return make_model(context, make_box(context),
                    make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5),
                    make_foam(context, MSQ_FOAM_AUTO));
}

/* How many of the points scale 0 leaves, and how many scale 1 does. */
static void living(const msq_model* model, const msq_points_def* def, uint64_t left[2]) {
  double(*at)[3] = (double(*)[3])malloc(count * sizeof *at);
  const double scales[2] = {INFINITY, 2};
  assert_non_null(at);
  assert_ok(msq_points_generate(def, 0, count, at[0]));
  for (int k = 0; k < 2; ++k) {
    msq_query_def query;
    assert_ok(msq_query_def_init(&query, sizeof query));
    query.length_scale = scales[k];
    left[k] = 0;
    for (int i = 0; i < count; ++i) {
      int32_t inside = -1;
      assert_ok(msq_point_membership(model, at[i], &query, &inside));
      left[k] += (uint64_t)inside;
    }
  }
  free(at);
}

/* Scale 1 is asked about what scale 0 leaves, scale 2 about what scale 1 leaves, nothing twice. */
static void what_a_scale_answers_is_not_asked_of_finer_ones(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_three_scales(context);
  (void)state;
  for (int32_t kind = MSQ_POINTS_ARRAY; kind <= MSQ_POINTS_STRATIFIED; ++kind) {
    const msq_points_def def = definition(kind);
    uint64_t left[2];
    living(model, &def, left);
    for (int32_t method = MSQ_QUERY_AUTO; method <= MSQ_QUERY_SET; ++method) {
      const msq_job_report report = ask(model, &def, count, method, 0, 0);
      assert_int_equal(report.points, count);
      assert_int_equal(report.by_shape, count - left[0]);
      assert_int_equal(report.by_point + report.by_set, left[0] + left[1]);
      if (method == MSQ_QUERY_POINT) {
        assert_int_equal(report.by_set, 0);
        assert_int_equal(report.groups, 0);
      } else {
        assert_true(report.groups > 0);
      }
      if (method == MSQ_QUERY_SET) assert_int_equal(report.by_point, 0);
    }
    const msq_job_report coarse = ask(model, &def, count, MSQ_QUERY_AUTO, 0, INFINITY);
    assert_int_equal(coarse.by_shape, count);
    assert_int_equal(coarse.by_point + coarse.by_set + coarse.groups, 0);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void the_critical_count_decides(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
  const msq_points_def def = definition(MSQ_POINTS_STRATIFIED);
  (void)state;
  const msq_job_report all = ask(model, &def, count, MSQ_QUERY_AUTO, 1, 0);
  assert_int_equal(all.by_point, 0);
  assert_int_equal(all.by_set, count - all.by_shape);
  const msq_job_report none = ask(model, &def, count, MSQ_QUERY_AUTO, count + 1, 0);
  assert_int_equal(none.by_set, 0);
  assert_int_equal(none.by_point, all.by_set);
  msq_model_release(model);
  msq_context_release(context);
}

/* Grouped by parts of cells the answers are the same. */
static void cells_can_be_divided(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
  msq_points_def def = definition(MSQ_POINTS_ARRAY);
  uint8_t inside[2][count];
  msq_job_report report[2];
  (void)state;
  for (uint32_t i = 0; i < 2; ++i) {
    msq_query_def query;
    msq_job* job;
    double near[count][3]; /* all in one cell */
    const double(*points)[3] = (const double(*)[3])random_points();
    for (int k = 0; k < count; ++k)
      for (int axis = 0; axis < 3; ++axis) near[k][axis] = 1.5 + 0.15 * (points[k][axis] - 2);
    def.coordinates = near;
    assert_ok(msq_query_def_init(&query, sizeof query));
    query.group_parts = i ? 64 : 1;
    assert_ok(msq_job_create(&job));
    assert_ok(msq_set_membership(model, &def, &query, inside[i], count, job));
    report[i] = counts_of(job);
    msq_job_release(job);
  }
  assert_memory_equal(inside[0], inside[1], count);
  assert_int_equal(report[0].by_set + report[0].by_point, report[1].by_set + report[1].by_point);
  assert_int_equal(report[0].groups, 1);
  assert_int_equal(report[1].groups, 8);
  msq_model_release(model);
  msq_context_release(context);
}

/* A call begins with all numbers 0. */
static void numbers_are_those_of_the_last_call(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_points_def def = definition(MSQ_POINTS_ARRAY);
  uint8_t inside[count];
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_int_equal(counts_of(job).points, 0);
  for (int i = 0; i < 2; ++i) {
    assert_ok(msq_set_membership(model, &def, NULL, inside, count, job));
    assert_int_equal(counts_of(job).points, count);
  }
  def.count = 0;
  assert_ok(msq_set_membership(model, &def, NULL, inside, 0, job));
  assert_int_equal(counts_of(job).points, 0);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_a_scale_answers_is_not_asked_of_finer_ones),
      cmocka_unit_test(the_critical_count_decides),
      cmocka_unit_test(cells_can_be_divided),
      cmocka_unit_test(numbers_are_those_of_the_last_call),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
