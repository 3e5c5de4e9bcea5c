/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_calibrate against closed forms: strut lattices (exact for thin struts), triply
 * periodic functions (fractions by integrals, derived), thin foams (edge length per volume,
 * measured with voro++). Every tolerance is 4.5 standard errors of the sample, as msq says them. */
#include "definitions.h"

static const double pi = 3.14159265358979323846;

static msq_calibration_report report_of(void) {
  msq_calibration_report report = {0};
  report.struct_size = sizeof report;
  return report;
}

/* At the parameter that msq finds for a fraction, the known fraction is the target. */
static void check_fraction(const char* name, const msq_calibration_report* found, double target,
                           double low, double high) {
  const double error = 4.5 * found->fraction.standard_error;
  print_message("%s: parameter %.6g for %.6g, known fraction %.6g to %.6g, standard error %.2g\n",
                name, found->parameter, target, low, high, found->fraction.standard_error);
  assert_true(found->fraction.value >= target && found->fraction.value < target + 1e-4);
  assert_true(found->fraction.low <= target && target <= found->fraction.high);
  assert_true(low <= target + error && high >= target - error);
}

static void lattices_have_their_closed_forms(void** state) {
  msq_context* context = make_context();
  const double k = sqrt(2.0);
  (void)state;
  for (int cell = MSQ_UNIT_CELL_CUBIC; cell <= MSQ_UNIT_CELL_OCTET; ++cell)
    for (int thick = 0; thick < 2; ++thick) {
      const double target = thick ? 0.2 : 0.02, a = 2;
      msq_structure* structure = make_lattice_of(context, cell, a, 0.3);
      msq_calibration_report found = report_of();
      assert_ok(
          msq_structure_calibrate(context, structure, NULL, target, NULL, NULL, 0, &found, NULL));
      assert_int_equal(found.samples, 2 * 64 * 64 * 64);
      assert_true(found.max_fraction == 1);
      const double r = found.parameter / a, l = r * k; /* octet: struts are a / sqrt 2 long */
      const double known = cell == MSQ_UNIT_CELL_CUBIC ? 3 * pi * r * r - 8 * k * r * r * r
                           : cell == MSQ_UNIT_CELL_BCC
                               ? 4 * sqrt(3.0) * pi * r * r - 16 * sqrt(6.0) * r * r * r
                               : 6 * k * pi * l * l - 54.627 * l * l * l;
      check_fraction("lattice", &found, target, known, known);
      msq_structure_release(structure);
    }
  msq_context_release(context);
}

/* Struts along the edges of cells of 2 are among those along the edges of cells of 1: their union
 * has the closed form of the latter. The usual sample is one of 16^3 of the larger cells. */
static void unions_have_one_radius_for_all(void** state) {
  const double target = 0.1;
  msq_context* context = make_context();
  msq_structure* const both[2] = {make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.1),
                                  make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.3)};
  msq_structure* made;
  msq_calibration_report found = report_of(), same = report_of();
  msq_points_def sample;
  (void)state;
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, (const msq_structure* const*)both, 2, &made));
  assert_ok(msq_structure_calibrate(context, made, NULL, target, NULL, NULL, 0, &found, NULL));
  const double r = found.parameter, known = 3 * pi * r * r - 8 * sqrt(2.0) * r * r * r;
  assert_int_equal(found.samples, 2 * 64 * 64 * 64);
  check_fraction("union", &found, target, known, known);
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis) {
    sample.spacing[axis] = 0.5;
    sample.counts[axis] = 64;
  }
  assert_ok(msq_structure_calibrate(context, made, &sample, target, NULL, NULL, 0, &same, NULL));
  assert_true(same.parameter == found.parameter);
  msq_structure_release(made);
  for (int i = 0; i < 2; ++i) msq_structure_release(both[i]);
  msq_context_release(context);
}

static void functions_have_their_fractions(void** state) {
  static const struct {
    int32_t function;
    double level, fraction;
  } known[] = {{MSQ_FUNCTION_SCHWARZ_P, 0.5, 0.642835}, {MSQ_FUNCTION_SCHWARZ_P, 1.2, 0.832035},
               {MSQ_FUNCTION_GYROID, 0.1, 0.532186},    {MSQ_FUNCTION_GYROID, 1, 0.829725},
               {MSQ_FUNCTION_DIAMOND, 0.5, 0.705759},   {MSQ_FUNCTION_DIAMOND, 1, 0.919410}};
  msq_context* context = make_context();
  (void)state;
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i += test_scale() < 0.5 ? 2 : 1)
    for (int32_t kind = MSQ_FUNCTIONAL_NETWORK; kind <= MSQ_FUNCTIONAL_SHEET; ++kind) {
      const double target =
          kind == MSQ_FUNCTIONAL_SHEET ? 2 * known[i].fraction - 1 : known[i].fraction;
      msq_functional_def def;
      msq_structure* structure;
      msq_calibration_report found = report_of();
      assert_ok(msq_functional_def_init(&def, sizeof def));
      def.function = known[i].function;
      def.kind = kind;
      def.level.value = 0.25;
      assert_ok(msq_structure_functional(context, &def, &structure));
      assert_ok(
          msq_structure_calibrate(context, structure, NULL, target, NULL, NULL, 0, &found, NULL));
      /* The fraction's slope is that of the curve between 2 levels. */
      double parameters[101], fractions[101];
      assert_ok(msq_structure_calibrate(context, structure, NULL, target, parameters, fractions,
                                        101, NULL, NULL));
      const int at = (int)(target * 100);
      const double slope =
          (fractions[at + 1] - fractions[at]) / (parameters[at + 1] - parameters[at]);
      print_message("function %d, kind %d: level %.6f, known %.6f, standard error %.2g\n",
                    known[i].function, kind, found.parameter, known[i].level,
                    found.fraction.standard_error);
      assert_near(found.parameter, known[i].level,
                  1.2 * 4.5 * found.fraction.standard_error / slope + 1e-5);
      msq_structure_release(structure);
    }
  msq_context_release(context);
}

/* Thin struts fill pi r^2 L of space, except for their joints: 1 - 6 r to 1 + 1.6 r times that (see
 * tests/unit/test_volume_fraction.cpp). With little jitter the edges of the cubic lattice, L = 3,
 * come apart into pairs no farther from each other than the jitter: there struts overlap, and fill
 * at least what those of the cubic lattice do. */
static void thin_foams_have_their_edges(void** state) {
  static const double jitters[] = {0.01, 0.1, 0.5, 1}, edges[] = {5.988, 5.895, 5.690, 5.787};
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 4; ++i) {
    const double target = 0.01, a = 0.5;
    msq_foam_def def;
    msq_structure* structure;
    msq_calibration_report found = report_of();
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.jitter = jitters[i];
    def.seed = 5;
    def.radius.value = 0.1;
    set_cell(&def.grid, a);
    assert_ok(msq_structure_foam(context, &def, &structure));
    msq_points_def sample;
    assert_ok(msq_points_def_init(&sample, sizeof sample));
    sample.kind = MSQ_POINTS_STRATIFIED;
    sample.per_cell = 2;
    /* At least so many that one point is less than the fraction's tolerance. */
    const uint64_t side = (uint64_t)fmax(18, cbrt((double)test_count(45 * 45 * 45)));
    for (int axis = 0; axis < 3; ++axis) {
      sample.counts[axis] = side;
      sample.spacing[axis] = 16 * a / (double)side;
    }
    assert_ok(
        msq_structure_calibrate(context, structure, &sample, target, NULL, NULL, 0, &found, NULL));
    const double r = found.parameter / a, thin = pi * r * r * edges[i];
    const double least = jitters[i] < 0.5 ? 3 * pi * r * r : thin;
    check_fraction("foam", &found, target, least * (1 - 6 * r), thin * (1 + 1.6 * r));
    assert_true(found.max_fraction > 0.99);
    msq_structure_release(structure);
  }
  msq_context_release(context);
}

static msq_points_def small_sample(uint32_t per_cell, uint64_t side) {
  msq_points_def sample;
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = per_cell;
  for (int axis = 0; axis < 3; ++axis) {
    sample.counts[axis] = side;
    sample.spacing[axis] = 1.0 / (double)side;
  }
  return sample;
}

static void the_curve_ascends_and_threads_do_not_matter(void** state) {
  enum { pairs = 33 };
  const msq_points_def sample = small_sample(3, 20);
  double parameters[2][pairs], fractions[2][pairs];
  msq_calibration_report found[2] = {report_of(), report_of()};
  (void)state;
  for (uint32_t t = 0; t < 2; ++t) {
    msq_context* context = make_context_of(t + 1, 1 << 20, 0);
    msq_structure* foam = make_foam(context, MSQ_FOAM_AUTO);
    msq_job* job;
    assert_ok(msq_job_create(&job));
    assert_ok(msq_structure_calibrate(context, foam, &sample, 0.3, parameters[t], fractions[t],
                                      pairs, &found[t], job));
    assert_true(progress_of(job) == 1);
    msq_job_release(job);
    msq_structure_release(foam);
    msq_context_release(context);
  }
  assert_memory_equal(parameters[0], parameters[1], sizeof parameters[0]);
  assert_memory_equal(fractions[0], fractions[1], sizeof fractions[0]);
  assert_memory_equal(&found[0], &found[1], sizeof found[0]);
  assert_int_equal(found[0].samples, 24000);
  assert_true(fractions[0][0] == 0 && fractions[0][pairs - 1] == found[0].max_fraction);
  for (int i = 1; i < pairs; ++i) {
    assert_true(fractions[0][i] > fractions[0][i - 1]);
    assert_true(parameters[0][i] >= parameters[0][i - 1]);
  }
}

/* Where the greatest radius does not fill all space. */
static void the_limit_of_the_radius_is_respected(void** state) {
  msq_context* context = make_context();
  msq_lattice_def def;
  msq_structure* structure;
  msq_calibration_report found = report_of();
  double parameters[2], fractions[2];
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  const double nodes[2][3] = {{0.5, 0.5, 0}, {0.5, 0.5, 1}};
  const uint32_t strut[2] = {0, 1};
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = nodes[0];
  def.node_count = 2;
  def.struts = strut;
  def.strut_count = 1;
  def.radius.value = 0.5;
  def.grid.cell_size[0] = 16; /* the limit is 4: 8 of 16 */
  assert_ok(msq_structure_lattice(context, &def, &structure));
  msq_points_def sample = small_sample(2, 30);
  sample.spacing[0] *= 16;
  assert_ok(msq_structure_calibrate(context, structure, &sample, 0.4, parameters, fractions, 2,
                                    &found, NULL));
  assert_near(found.max_fraction, 0.5, 0.01);
  assert_true(fractions[1] == found.max_fraction && parameters[1] <= 4 && parameters[1] > 3.95);
  const msq_calibration_report before = found;
  assert_refused(msq_structure_calibrate(context, structure, &sample, 0.6, parameters, fractions, 2,
                                         &found, NULL),
                 MSQ_E_LIMIT, "target is 0.6; the greatest parameter, 4");
  assert_memory_equal(&before, &found, sizeof found);
  msq_structure_release(structure);
  msq_context_release(context);
}

struct call {
  msq_context* context;
  msq_structure* structure;
};

static int32_t nothing_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static int32_t no_values(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  (void)points;
  memset(values, 0, count * sizeof *values);
  return 0;
}

/* Lattices of several unit cells, and what the host computes. */
static void kinds_without_onset_are_refused(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[3];
  msq_unit_cell_def cells[2];
  msq_lattice_def lattice;
  msq_host_structure_def host;
  msq_host_function_def function;
  (void)state;
  for (int i = 0; i < 2; ++i) assert_ok(msq_unit_cell_def_init(&cells[i], sizeof cells[i]));
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.cells = cells;
  lattice.cell_count = 2;
  lattice.radius.value = 0.1;
  assert_ok(msq_structure_lattice(context, &lattice, &structures[0]));
  assert_ok(msq_host_structure_def_init(&host, sizeof host));
  host.inside = nothing_inside;
  assert_ok(msq_structure_host(context, &host, &structures[1]));
  assert_ok(msq_host_function_def_init(&function, sizeof function));
  function.evaluate = no_values;
  assert_ok(msq_structure_host_function(context, &function, &structures[2]));
  for (int i = 0; i < 3; ++i) {
    msq_calibration_report found = report_of();
    assert_refused(
        msq_structure_calibrate(context, structures[i], NULL, 0.5, NULL, NULL, 0, &found, NULL),
        MSQ_E_UNSUPPORTED, "no onset");
    msq_structure_release(structures[i]);
  }
  lattice.cell_count = 1; /* as the unit cell by itself */
  assert_ok(msq_structure_lattice(context, &lattice, &structures[0]));
  assert_ok(msq_structure_calibrate(context, structures[0], NULL, 0.1, NULL, NULL, 0, NULL, NULL));
  msq_structure_release(structures[0]);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattices_have_their_closed_forms),
      cmocka_unit_test(unions_have_one_radius_for_all),
      cmocka_unit_test(functions_have_their_fractions),
      cmocka_unit_test(thin_foams_have_their_edges),
      cmocka_unit_test(the_curve_ascends_and_threads_do_not_matter),
      cmocka_unit_test(the_limit_of_the_radius_is_respected),
      cmocka_unit_test(kinds_without_onset_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
