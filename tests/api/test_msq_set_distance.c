/* SPDX-License-Identifier: Apache-2.0
 * msq_set_distance. What else msq_points_def may hold: test_msq_set_membership.c, which shares the
 * reading of it. */
#include "arrays.h"

/* Asks for `few` answers; on failure none may be written. */
static msq_status ask(void* env, void* def) {
  double distance[few];
  memset(distance, struct_pattern, sizeof distance);
  const msq_status status = msq_set_distance((const msq_model*)env, (const msq_points_def*)def,
                                             NULL, distance, few, NULL);
  if (status != MSQ_OK) assert_filled(distance, sizeof distance, struct_pattern);
  return status;
}

static double distance_of(const msq_model* model, const double* point) {
  double distance = NAN;
  assert_ok(msq_point_distance(model, point, NULL, &distance));
  return distance;
}

/* The answers are those of msq_point_distance, to the last bit; `coordinates` as msq sees them. */
static void assert_answers(const msq_model* model, const msq_points_def* def,
                           const double (*coordinates)[3], uint64_t count) {
  double* distance = (double*)malloc((count + 2) * sizeof *distance);
  assert_non_null(distance);
  memset(distance, struct_pattern, (count + 2) * sizeof *distance);
  assert_ok(msq_set_distance(model, def, NULL, distance + 1, count, NULL));
  assert_filled(distance, sizeof *distance, struct_pattern);
  assert_filled(distance + count + 1, sizeof *distance, struct_pattern);
  for (uint64_t i = 0; i < count; ++i) {
    const double wanted = distance_of(model, coordinates[i]);
    assert_memory_equal(distance + i + 1, &wanted, sizeof wanted);
  }
  free(distance);
}

static void arrays_have_any_type_and_stride(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  (void)state;
  check_array(model, test_count(1000), MSQ_FLOAT64, 0, assert_answers);
  check_array(model, test_count(1000), MSQ_FLOAT64, 31, assert_answers);
  check_array(model, test_count(1000), MSQ_FLOAT32, 0, assert_answers);
  check_array(model, test_count(1000), MSQ_FLOAT32, 17, assert_answers);
  msq_model_release(model);
  msq_context_release(context);
}

/* Work is divided among threads in chunks: counts about their borders. */
static void arrays_have_any_length(void** state) {
  const uint64_t counts[] = {1, 2, 1023, 1024, 1025, 4097};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  (void)state;
  for (int i = 0; i < 6; ++i) check_array(model, counts[i], MSQ_FLOAT64, 0, assert_answers);
  msq_model_release(model);
  msq_context_release(context);
}

/* Three different counts, so that every other order of the answers shows. */
static void check_grid(const msq_model* model) {
  enum { nx = 70, ny = 9, nz = 5, count = nx * ny * nz };
  const uint64_t n[3] = {nx, ny, nz};
  static double seen[count][3];
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = -0.2 - 0.01 * axis;
    def.spacing[axis] = 4.5 / (double)n[axis];
    def.counts[axis] = n[axis];
  }
  for (uint64_t i = 0; i < count; ++i) {
    seen[i][0] = def.origin[0] + (double)(i % nx) * def.spacing[0];
    seen[i][1] = def.origin[1] + (double)(i / nx % ny) * def.spacing[1];
    seen[i][2] = def.origin[2] + (double)(i / nx / ny) * def.spacing[2];
  }
  assert_answers(model, &def, (const double(*)[3])seen, count);
}

static void every_kind_of_model_answers_sets_as_points(void** state) {
  msq_context* context = make_context();
  const double middle[3] = {2, 2, 2};
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, middle, 2, &ball));
  msq_model* models[] = {
      make_box_model(context),
      make_shape_model(context, make_cube_mesh(context)),
      make_shape_model(context, ball),
      make_foam_model(context, MSQ_FOAM_AUTO),
      make_model(context, make_cube_mesh(context), make_lattice(context),
                 make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 0.5, 0.05)),
  };
  for (size_t i = 0; i < sizeof models / sizeof models[0]; ++i) {
    check_array(models[i], test_count(2000), MSQ_FLOAT64, 0, assert_answers);
    check_grid(models[i]);
    msq_model_release(models[i]);
  }
  msq_context_release(context);
}

static void finer_scales_are_left_out_at_a_length_scale(void** state) {
  enum { side = 12, samples = side * side * side };
  const msq_points_def grid = grid_points(0, 4, side);
  double wanted[samples], got[samples];
  msq_context* context = make_context();
  msq_model* all =
      make_model(context, make_box(context), make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5),
                 make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0.5, 0.1));
  msq_model* coarse = make_model(context, make_box(context),
                                 make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5), NULL);
  msq_query_def query;
  (void)state;
  assert_ok(msq_query_def_init(&query, sizeof query));
  query.length_scale = 1;
  assert_ok(msq_set_distance(all, &grid, &query, got, samples, NULL));
  assert_ok(msq_set_distance(coarse, &grid, NULL, wanted, samples, NULL));
  assert_memory_equal(got, wanted, sizeof got);
  msq_model_release(all);
  msq_model_release(coarse);
  msq_context_release(context);
}

static void no_points_is_nothing_to_do(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_points_def def = array_of(NULL, 0);
  (void)state;
  assert_ok(msq_set_distance(model, &def, NULL, NULL, 0, NULL));
  msq_model_release(model);
  msq_context_release(context);
}

/* No room for the tree of a mesh: nothing is written. */
static void a_limit_leaves_the_output_alone(void** state) {
  msq_context* wide = make_context();
  msq_shape* shape = make_cube_mesh(wide);
  const uint64_t bytes = memory_of(wide).bytes, peak = memory_of(wide).peak_bytes;
  const msq_points_def def = array_of(few_points(), few);
  (void)state;
  msq_context* narrow = make_context_of(2, 0, bytes > peak ? bytes : peak);
  msq_model* model = make_shape_model(narrow, make_cube_mesh(narrow));
  assert_refused(ask(model, (void*)&def), MSQ_E_LIMIT, "memory_limit");
  msq_model_release(model);
  msq_context_release(narrow);
  msq_shape_release(shape);
  msq_context_release(wide);
}

/* Arrays are sorted, in runs of a quarter of the points of each thread, or of fewer where the limit
 * has no room for that. */
static void long_arrays_need_no_room(void** state) {
  const uint64_t count = 4 * 4250;
  msq_context* wide = make_context_of(1, 0, 0);
  msq_model* model = make_shape_model(wide, make_cube_mesh(wide));
  (void)state;
  check_array(model, count, MSQ_FLOAT32, 17, assert_answers);
  assert_true(memory_of(wide).peak_bytes > 4250 * 40);
  msq_model_release(model);
  msq_context_release(wide);
  msq_context* narrow = make_context_of(1, 0, 100000);
  model = make_shape_model(narrow, make_cube_mesh(narrow));
  check_array(model, count, MSQ_FLOAT32, 17, assert_answers);
  assert_true(memory_of(narrow).peak_bytes < 100000);
  msq_model_release(model);
  msq_context_release(narrow);
}

static void jobs_show_progress_and_cancel(void** state) {
  enum { side = 20, samples = side * side * side };
  const msq_points_def grid = grid_points(0, 4, side);
  static double distance[samples];
  (void)state;
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, (uint64_t)1 << 20, 0);
    msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
    const msq_points_def array = array_of(few_points(), few);
    msq_job* job;
    assert_ok(msq_job_create(&job));
    assert_ok(msq_set_distance(model, &grid, NULL, distance, samples, job));
    assert_true(progress_of(job) == 1);
    assert_ok(msq_set_distance(model, &array, NULL, distance, few, job));
    assert_true(progress_of(job) == 1);
    assert_ok(msq_job_cancel(job));
    assert_refused(msq_set_distance(model, &grid, NULL, distance, samples, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_refused(msq_set_distance(model, &array, NULL, distance, few, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_true(progress_of(job) == 0);
    msq_job_release(job);
    msq_model_release(model);
    msq_context_release(context);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arrays_have_any_type_and_stride),
      cmocka_unit_test(arrays_have_any_length),
      cmocka_unit_test(every_kind_of_model_answers_sets_as_points),
      cmocka_unit_test(finer_scales_are_left_out_at_a_length_scale),
      cmocka_unit_test(no_points_is_nothing_to_do),
      cmocka_unit_test(a_limit_leaves_the_output_alone),
      cmocka_unit_test(long_arrays_need_no_room),
      cmocka_unit_test(jobs_show_progress_and_cancel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
