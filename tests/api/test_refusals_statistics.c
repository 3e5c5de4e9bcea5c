/* SPDX-License-Identifier: Apache-2.0
 * What samples, statistics and windows of points refuse. */
#include "samples.h"
#include "wrong_values.h"

static msq_context* context;
static msq_model *plain, *boxed; /* a lattice in a box; the box */

static int32_t no_points_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static msq_points_def* sample_at(int number) {
  msq_points_def* sample = (msq_points_def*)definition(number);
  *sample = sample_of(0, 4, 4, 2);
  return sample;
}

static void samples(void** state) {
  (void)state;
  REFUSALS("msq_points_generate") { /* 3 x 4 x 5 cells of 2 points */
    msq_points_def* points = sample_at(0);
    uint64_t first = 0, count = 8;
    double* coordinates = (double*)output(0);
    for (int axis = 0; axis < 3; ++axis) {
      points->origin[axis] = 0.125 * axis;
      points->counts[axis] = 3 + (uint64_t)axis;
    }
    wrong_sizes(table, points, offsetof(msq_points_def, seed), sizeof *points);
    WRONG(ARGUMENT, "coordinates is NULL", coordinates = NULL);
    RIGHT(first = 5; count = 0; coordinates = NULL);
    RIGHT(first = 119; count = 1);
    WRONG(ARGUMENT, "120", first = 119; count = 2);
    WRONG(ARGUMENT, "121", first = 121; count = 0);
    WRONG(ARGUMENT, "120", first = UINT64_MAX; count = 2);
    WRONG(ARGUMENT, "per_cell is 0", points->per_cell = 0);
    WRONG(ARGUMENT, "reserved2 is 5", points->reserved2 = 5);
    for (int axis = 0; axis < 3; ++axis) {
      WRONG(ARGUMENT, "counts", points->counts[axis] = 0);
      WRONG(ARGUMENT, "2147483648", points->counts[axis] = (uint64_t)1 << 31);
      WRONG(ARGUMENT, "spacing is 0", points->spacing[axis] = 0);
      WRONG(ARGUMENT, "the last cell's coordinate is inf", points->spacing[axis] = 1e308);
      WRONG(ARGUMENT, "determinant", points->rotation[4 * axis] = -1);
      wrong_number(table, points->rotation + 4 * axis, "rotation");
    }
    wrong_vector(table, points->origin, "origin");
    WRONG(LIMIT, "points", points->counts[0] = points->counts[1] = points->counts[2] = INT32_MAX);
    WRONG(ARGUMENT, "points is NULL", points = NULL);
    TRY(msq_points_generate(points, first, count, coordinates));
  }
  REFUSALS("msq_volume_fraction") {
    const msq_model* model = plain;
    msq_points_def* sample = sample_at(0);
    msq_query_def* query = any_query(1);
    int32_t phase = MSQ_PHASE_SOLID;
    msq_estimate* estimate = (msq_estimate*)output(0);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "estimate is NULL", estimate = NULL);
    wrong_enum(table, &phase, "phase", 1, 2);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    wrong_sample(table, sample);
    wrong_query(table, query);
    WRONG(ARGUMENT, "sample is NULL", sample = NULL);
    RIGHT(query = NULL);
    TRY(msq_volume_fraction(model, sample, query, phase, estimate, job));
  }
}

static void wrong_segments(const char* function, segments_fn ask) {
  const double wrong[] = {-0.1, NAN, INFINITY, -INFINITY};
  REFUSALS(function) {
    double own[2] = {0.5, 0}, *lengths = own;
    const msq_model* model = plain;
    msq_points_def* sample = sample_at(0);
    msq_query_def* query = any_query(1);
    msq_segments_def* def = (msq_segments_def*)definition(2);
    msq_estimate* estimates = (msq_estimate*)output(0);
    uint64_t count = 2;
    msq_job* job = NULL;
    *def = segments_of(lengths, 2, MSQ_PHASE_SOLID, NULL);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "estimates is NULL", estimates = NULL);
    WRONG(ARGUMENT, "there are 2 lengths", count = 1);
    WRONG(ARGUMENT, "there are 2 lengths", count = 3);
    wrong_enum(table, &def->phase, "phase", 1, 2);
    WRONG(ARGUMENT, "lengths is NULL", def->lengths = NULL);
    WRONG(ARGUMENT, "length_count is 0", def->length_count = 0);
    WRONG(ARGUMENT, "4097", def->length_count = 4097);
    for (int i = 0; i < 4; ++i) WRONG(ARGUMENT, "length 1 is ", own[1] = wrong[i]);
    wrong_vector(table, def->direction, "direction");
    WRONG(ARGUMENT, "too short", memset(def->direction, 0, sizeof def->direction);
          def->direction[1] = 5e-324);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    wrong_sample(table, sample);
    wrong_query(table, query);
    WRONG(ARGUMENT, "sample is NULL", sample = NULL);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    RIGHT(query = NULL);
    TRY(ask(model, sample, query, def, estimates, count, job));
  }
}

static void segments(void** state) {
  (void)state;
  wrong_segments("msq_two_point_correlation", msq_two_point_correlation);
  wrong_segments("msq_lineal_path", msq_lineal_path);
  REFUSALS("msq_lineal_path") {
    const double apart[2] = {2, 1};
    const msq_points_def sample = sample_of(0, 4, 4, 2);
    msq_segments_def def = segments_of(apart, 2, MSQ_PHASE_SOLID, NULL);
    msq_estimate* estimates = (msq_estimate*)output(0);
    RIGHT(def.step = 2e-6);
    WRONG(LIMIT, "1.9e-06", def.step = 1.9e-6);
    WRONG(ARGUMENT, "step is -1", def.step = -1);
    WRONG(ARGUMENT, "step is nan", def.step = NAN);
    WRONG(ARGUMENT, "step is inf", def.step = INFINITY);
    TRY(msq_lineal_path(boxed, &sample, NULL, &def, estimates, 2, NULL));
  }
}

static void calibrations(void** state) {
  const double targets[] = {-0.1, 1.1, NAN, INFINITY};
  msq_context* small = make_context_of(2, 0, 1 << 20);
  msq_structure *lattice = make_lattice(context), *of_small = make_lattice(small), *host, *around;
  msq_host_structure_def def;
  msq_warp_def warp;
  msq_foam_def foam_def;
  (void)state;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 12;
  warp.inner_radius = 2;
  warp.outer_radius = 3;
  assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.value = 0.25;
  foam_def.warp = &warp;
  assert_ok(msq_structure_foam(context, &foam_def, &around));
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = no_points_inside;
  assert_ok(msq_structure_host(context, &def, &host));
  REFUSALS("msq_structure_calibrate") {
    msq_context* in = context;
    const msq_structure* structure = lattice;
    msq_points_def* sample = sample_at(0);
    double target = 0.25;
    double *parameters = (double*)output(0), *fractions = (double*)output(1);
    uint64_t count = 2;
    msq_calibration_report* report = (msq_calibration_report*)output(2);
    msq_job* job = NULL;
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(UNSUPPORTED, "no onset", structure = host);
    for (int i = 0; i < 4; ++i) WRONG(ARGUMENT, "target is ", target = targets[i]);
    WRONG(ARGUMENT, "pair_count is 1", count = 1);
    WRONG(ARGUMENT, "pair_count is 0; parameters must be NULL", count = 0; fractions = NULL);
    WRONG(ARGUMENT, "pair_count is 0; fractions must be NULL", count = 0; parameters = NULL);
    WRONG(ARGUMENT, "from 2 to 1048576", count = (1 << 20) + 1);
    WRONG(ARGUMENT, "parameters is NULL", parameters = NULL);
    WRONG(ARGUMENT, "fractions is NULL", fractions = NULL);
    WRONG(ARGUMENT, "struct_size", report->struct_size = sizeof *report - 1);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(report = NULL);
    RIGHT(parameters = fractions = NULL; count = 0);
    wrong_sample(table, sample);
    WRONG(ARGUMENT, "sample is NULL|around an axis", structure = around; sample = NULL);
    /* The default: 2 * 64^3 points of 16 bytes. */
    WRONG(LIMIT, "8388608", in = small; structure = of_small; sample = NULL);
    TRY(msq_structure_calibrate(in, structure, sample, target, parameters, fractions, count, report,
                                job));
  }
  assert_int_equal(memory_of(small).bytes, 0);
  msq_structure_release(host);
  msq_structure_release(around);
  msq_structure_release(lattice);
  msq_structure_release(of_small);
  msq_context_release(small);
}

static void windows(void** state) {
  static const struct {
    msq_window window;
    const char* words;
  } wrong[] = {
      {{{0, 0, 0}, {42, 1, 1}}, "42|41"},
      {{{0, 41, 0}, {1, 1, 1}}, "41"},
      {{{0, 0, 40}, {1, 1, 2}}, "40|41"},
      {{{0, 1, 0}, {1, 0, 1}}, "count[1] is 0|at least 1"},
      {{{3, 0, 0}, {0, 0, 0}}, "count[0] is 0|at least 1"},
      {{{0, 0, UINT64_MAX}, {1, 1, 2}}, "18446744073709551615|41"},
      {{{0, 0, 2}, {1, 1, UINT64_MAX}}, "18446744073709551615|41"},
  };
  const msq_window one = {{0, 0, 0}, {1, 1, 1}};
  (void)state;
  REFUSALS("msq_set_membership") {
    msq_points_def* points = some_points(0);
    uint8_t* inside = (uint8_t*)output(0);
    uint64_t count = 1;
    const double* array = (const double*)points->coordinates;
    *points = grid_points(0, 4, 41);
    points->window = one;
    for (size_t i = 0; i < COUNT_OF(wrong); ++i)
      WRONG(ARGUMENT, wrong[i].words, points->window = wrong[i].window);
    WRONG(ARGUMENT, "arrays", points->kind = MSQ_POINTS_ARRAY; points->coordinates = array;
          points->count = 1);
    WRONG(ARGUMENT, "inside_count", count = 41 * 41 * 41);
    TRY(msq_set_membership(plain, points, NULL, inside, count, NULL));
  }
  REFUSALS("msq_points_generate") {
    msq_points_def* points = some_points(0);
    double* coordinates = (double*)output(0);
    uint64_t count = 1;
    *points = grid_points(0, 4, 41);
    points->window = one;
    for (size_t i = 0; i < COUNT_OF(wrong); ++i)
      WRONG(ARGUMENT, wrong[i].words, points->window = wrong[i].window);
    WRONG(ARGUMENT, "stratified", points->kind = MSQ_POINTS_STRATIFIED);
    WRONG(ARGUMENT, "there are", count = 2);
    TRY(msq_points_generate(points, 0, count, coordinates));
  }
  REFUSALS("msq_volume_fraction") {
    msq_points_def* sample = sample_at(0);
    msq_estimate* estimate = (msq_estimate*)output(0);
    WRONG(ARGUMENT, "stratified", sample->window = one);
    TRY(msq_volume_fraction(plain, sample, NULL, MSQ_PHASE_SOLID, estimate, NULL));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(samples),
      cmocka_unit_test(segments),
      cmocka_unit_test(calibrations),
      cmocka_unit_test(windows),
  };
  context = make_context();
  plain = make_lattice_model(context);
  boxed = make_box_model(context);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_model_release(plain);
  msq_model_release(boxed);
  msq_context_release(context);
  return failed;
}
