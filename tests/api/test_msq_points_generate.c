/* SPDX-License-Identifier: Apache-2.0
 * msq_points_generate, and stratified samples in general: what they are, and that queries of sets
 * see the points that it writes. */
#include "definitions.h"

static msq_points_def stratified(double low, double spacing, uint64_t side, uint32_t per_cell) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_STRATIFIED;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = low + 0.125 * axis;
    def.spacing[axis] = spacing * (1 + 0.5 * axis);
    def.counts[axis] = side + (uint64_t)axis;
  }
  def.per_cell = per_cell;
  def.seed = 7;
  return def;
}

static uint64_t points_of(const msq_points_def* def) {
  return def->counts[0] * def->counts[1] * def->counts[2] * def->per_cell;
}

static double (*generate(const msq_points_def* def, uint64_t count))[3] {
  double(*points)[3] = (double(*)[3])malloc(count * sizeof *points);
  assert_non_null(points);
  assert_ok(msq_points_generate(def, 0, count, points[0]));
  return points;
}

/* The same on every machine, for good: from the definition, by tests/golden/make_strata.py. */
static void the_numbers_are_those_of_the_definition(void** state) {
  static const double known[4][3] = {
      {0.43278543376002931, 0.34069802704974428, 0.78045847652560163},
      {0.23019907606814027, 0.17155575474032836, 0.85192842246411637},
      {0.57573870059817178, 1.5408695570456921, 0.72630659231242289},
      {999.88563270681823, 999.3381437855204, 999.21266033348729},
  };
  msq_points_def def;
  (void)state;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_STRATIFIED;
  def.seed = 42;
  def.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis) {
    def.spacing[axis] = 1;
    def.counts[axis] = 1000;
  }
  const uint64_t first[4] = {0, 1, 2000, 1999999999};
  for (int i = 0; i < 4; ++i) {
    double point[3];
    assert_ok(msq_points_generate(&def, first[i], 1, point));
    for (int axis = 0; axis < 3; ++axis)
      if (point[axis] != known[i][axis])
        fail_msg("point %d, axis %d: %.17g, not %.17g", i, axis, point[axis], known[i][axis]);
  }
}

static void each_point_is_in_its_cell(void** state) {
  const double c = 0.8, s = 0.6; /* about z */
  const double turn[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  msq_points_def def = stratified(-3, 0.25, 5, 3);
  (void)state;
  memcpy(def.rotation, turn, sizeof turn);
  const uint64_t count = points_of(&def);
  double(*points)[3] = generate(&def, count);
  double sum[3] = {0, 0, 0};
  for (uint64_t n = 0; n < count; ++n) {
    const uint64_t cell = n / def.per_cell;
    const uint64_t at[3] = {cell % def.counts[0], cell / def.counts[0] % def.counts[1],
                            cell / def.counts[0] / def.counts[1]};
    double d[3];
    for (int axis = 0; axis < 3; ++axis) d[axis] = points[n][axis] - def.origin[axis];
    const double within[3] = {c * d[0] + s * d[1], c * d[1] - s * d[0], d[2]};
    for (int axis = 0; axis < 3; ++axis) {
      const double part = within[axis] / def.spacing[axis] - (double)at[axis];
      assert_true(part >= -1e-9 && part <= 1 + 1e-9);
      sum[axis] += part;
    }
  }
  /* Uniform: standard deviation of the mean 0.29 / sqrt(630) = 0.0115. */
  for (int axis = 0; axis < 3; ++axis) assert_near(sum[axis] / (double)count, 0.5, 0.05);
  free(points);
}

static void seeds_differ_and_ranges_agree(void** state) {
  msq_points_def def = stratified(0, 1, 4, 3);
  const uint64_t count = points_of(&def);
  double(*points)[3] = generate(&def, count), part[50][3];
  (void)state;
  for (uint64_t first = 0; first + 50 <= count; first += 37) {
    assert_ok(msq_points_generate(&def, first, 50, part[0]));
    assert_memory_equal(part, points + first, sizeof part);
  }
  ++def.seed;
  assert_ok(msq_points_generate(&def, 0, 50, part[0]));
  for (int i = 0; i < 50; ++i) assert_true(part[i][0] != points[i][0]);
  free(points);
}

static void grids_and_arrays_are_written_too(void** state) {
  const float array[2][4] = {{1, 2, 3, -1}, {4, 5, 6, -1}};
  msq_points_def def;
  double points[8][3];
  (void)state;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.coordinates = array;
  def.count = 2;
  def.stride = sizeof array[0];
  def.coordinate_type = MSQ_FLOAT32;
  assert_ok(msq_points_generate(&def, 1, 1, points[0]));
  for (int axis = 0; axis < 3; ++axis) assert_true(points[0][axis] == 4 + axis);

  def = stratified(1, 0.5, 2, 1);
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) def.counts[axis] = 2;
  assert_ok(msq_points_generate(&def, 0, 8, points[0]));
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      assert_true(points[i][axis] == def.origin[axis] + (i >> axis & 1) * def.spacing[axis]);
}

/* Queries of a sample answer about the points written, in their order. */
static void check_queries(const msq_model* model, const msq_points_def* def) {
  const uint64_t count = points_of(def);
  double(*points)[3] = generate(def, count);
  uint8_t* inside = (uint8_t*)malloc(count);
  double* distance = (double*)malloc(count * sizeof *distance);
  uint64_t held = 0;
  assert_non_null(inside);
  assert_non_null(distance);
  for (int method = MSQ_QUERY_AUTO; method <= MSQ_QUERY_SET; ++method) {
    msq_query_def query;
    assert_ok(msq_query_def_init(&query, sizeof query));
    query.method = method;
    memset(inside, struct_pattern, count);
    assert_ok(msq_set_membership(model, def, &query, inside, count, NULL));
    for (uint64_t i = 0; i < count; ++i) {
      int32_t wanted = -1;
      assert_ok(msq_point_membership(model, points[i], NULL, &wanted));
      assert_int_equal(inside[i], wanted);
      held += inside[i];
    }
  }
  assert_true(held > 0 && held < 3 * count);
  assert_ok(msq_set_distance(model, def, NULL, distance, count, NULL));
  for (uint64_t i = 0; i < count; ++i) {
    double wanted = NAN;
    assert_ok(msq_point_distance(model, points[i], NULL, &wanted));
    assert_memory_equal(distance + i, &wanted, sizeof wanted);
  }
  free(points);
  free(inside);
  free(distance);
}

static void sets_see_these_points(void** state) {
  msq_context* context = make_context();
  msq_model* models[] = {make_box_model(context), make_lattice_model(context),
                         make_foam_model(context, MSQ_FOAM_AUTO),
                         make_foam_model(context, MSQ_FOAM_METHOD_1)};
  msq_points_def all[] = {stratified(-0.2, 0.31, 10, 1), stratified(-0.2, 0.93, 3, 16),
                          stratified(-0.2, 1.41, 2, 100)};
  msq_points_def one = stratified(-0.2, 3, 1, 5000); /* more points in a cell than a part has */
  (void)state;
  for (int axis = 0; axis < 3; ++axis) one.counts[axis] = 1;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) check_queries(models[i], &all[k]);
    if (test_scale() >= 1 || i == 2) check_queries(models[i], &one);
    msq_model_release(models[i]);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_numbers_are_those_of_the_definition),
      cmocka_unit_test(each_point_is_in_its_cell),
      cmocka_unit_test(seeds_differ_and_ranges_agree),
      cmocka_unit_test(grids_and_arrays_are_written_too),
      cmocka_unit_test(sets_see_these_points),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
