/* SPDX-License-Identifier: Apache-2.0
 * Arguments that are far away, that multiply, or that leave the range of numbers are refused, or
 * answered in little time; and objects that callbacks let go stay until the end of the call. */
#include "definitions.h"
#include "fills.h"
#include "layers.h"
#include "periods.h"

static msq_structure* periodic_lattice(msq_context* context) {
  const msq_period_def period = period_def();
  msq_lattice_def def;
  msq_structure* made;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.radius.value = 0.1;
  def.period = &period;
  assert_ok(msq_structure_lattice(context, &def, &made));
  return made;
}

static msq_structure* periodic_foam(msq_context* context) {
  const msq_period_def period = period_def();
  msq_foam_def def;
  msq_structure* made;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  def.period = &period;
  assert_ok(msq_structure_foam(context, &def, &made));
  return made;
}

/* Cells beyond 2^24 have no index. */
static void samples_far_away_are_refused(void** state) {
  msq_context* context = make_context();
  msq_structure* const kinds[] = {periodic_lattice(context), periodic_foam(context),
                                  make_lattice(context), make_foam(context, MSQ_FOAM_AUTO)};
  const double far[] = {1e10, 1e20, 1e75, 1e80};
  msq_calibration_report report;
  msq_points_def sample;
  (void)state;
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis) {
    sample.counts[axis] = 6;
    sample.spacing[axis] = 0.3;
  }
  memset(&report, 0x5a, sizeof report);
  report.struct_size = sizeof report;
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
    for (size_t n = 0; n < sizeof far / sizeof *far; ++n) {
      for (int axis = 0; axis < 3; ++axis) sample.origin[axis] = far[n];
      assert_status(
          msq_structure_calibrate(context, kinds[k], &sample, 0.1, NULL, NULL, 0, &report, NULL),
          MSQ_E_LIMIT);
      assert_true(((unsigned char*)&report)[8] == 0x5a);
    }
    msq_structure_release(kinds[k]);
  }
  msq_context_release(context);
}

/* Of a grid that reaches far beyond the shape, its samples beyond are outside. */
static void grids_may_be_far_larger_than_the_shape(void** state) {
  const double reaches[] = {1e18, 1e30, 1e75};
  static uint8_t inside[5 * 5 * 5];
  msq_context* context = make_context();
  msq_structure* const kinds[] = {periodic_lattice(context), periodic_foam(context)};
  (void)state;
  for (size_t k = 0; k < 2; ++k) {
    msq_model* model = make_model(context, make_box(context), kinds[k], NULL);
    for (size_t n = 0; n < sizeof reaches / sizeof *reaches; ++n) {
      const msq_points_def grid = grid_points(-reaches[n], reaches[n], 5);
      uint64_t count = 0;
      memset(inside, 2, sizeof inside);
      assert_ok(msq_set_membership(model, &grid, NULL, inside, sizeof inside, NULL));
      for (size_t i = 0; i < sizeof inside; ++i) count += inside[i];
      assert_true(count <= 1); /* the origin */
    }
    msq_model_release(model);
  }
  msq_context_release(context);
}

/* Each union of a shape with itself doubles what a query takes. */
static void shapes_are_counted_with_repetition(void** state) {
  const double center[3] = {0, 0, 0};
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 1, &shape));
  for (int i = 0; i < 12; ++i) {
    const msq_shape* const pair[2] = {shape, shape};
    msq_shape* joined;
    assert_ok(
        msq_shape_boolean(i % 2 ? MSQ_BOOLEAN_INTERSECTION : MSQ_BOOLEAN_UNION, pair, 2, &joined));
    msq_shape_release(shape);
    shape = joined;
  }
  for (int is_wide = 0; is_wide < 2; ++is_wide) {
    const msq_shape* pair[3];
    msq_shape* inner = NULL;
    const double matrix[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
    assert_ok(msq_shape_placed(shape, matrix, &inner));
    pair[0] = pair[1] = pair[2] = inner;
    assert_makes_nothing(msq_shape,
                         msq_shape_boolean(MSQ_BOOLEAN_UNION, pair, is_wide ? 3 : 2, &made),
                         MSQ_E_LIMIT, is_wide ? "12288" : "8192");
    msq_shape_release(inner);
  }
  msq_shape_release(shape);
  msq_context_release(context);
}

static int32_t take_no_struts(void* user, const msq_strut* struts, uint64_t count) {
  (void)user;
  (void)struts;
  (void)count;
  return 7;
}

/* 2^66 blocks of cells. */
static void boxes_of_too_many_cells_are_refused(void** state) {
  msq_context* context = make_context();
  msq_structure* const kinds[] = {make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1),
                                  make_foam(context, MSQ_FOAM_AUTO)};
  (void)state;
  for (size_t k = 0; k < 2; ++k) {
    msq_struts_def def;
    msq_strut_graph* made = (msq_strut_graph*)untouched();
    assert_ok(msq_struts_def_init(&def, sizeof def));
    for (int axis = 0; axis < 3; ++axis) {
      def.min[axis] = -16777200;
      def.max[axis] = 16777200;
    }
    assert_status(msq_structure_struts(context, kinds[k], &def, take_no_struts, NULL, NULL),
                  MSQ_E_LIMIT);
    assert_status(msq_structure_strut_graph(context, kinds[k], &def, &made, NULL), MSQ_E_LIMIT);
    assert_ptr_equal(made, untouched());
    msq_structure_release(kinds[k]);
  }
  msq_context_release(context);
}

static void cell_sizes_of_a_fill_stay_numbers(void** state) {
  msq_context* context = make_context();
  msq_structure* foam = make_foam(context, MSQ_FOAM_AUTO);
  double size[3] = {1, 2, 3};
  (void)state;
  assert_refused(msq_fill_calibrate(context, foam, 0.4, 5e-324, size, NULL), MSQ_E_LIMIT, "1e75");
  assert_refused(msq_fill_calibrate(context, foam, 1e300, 1e-10, size, NULL), MSQ_E_LIMIT, "1e75");
  assert_refused(msq_fill_calibrate(context, foam, 1e-300, 1, size, NULL), MSQ_E_LIMIT, "1e-75");
  assert_true(size[0] == 1 && size[1] == 2 && size[2] == 3);
  msq_structure_release(foam);
  msq_context_release(context);
}

static double value_at(msq_context* context, const msq_field* field, const double point[3]) {
  msq_points_def def;
  double value = -1;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = point;
  def.count = 1;
  assert_ok(msq_field_evaluate(context, field, &def, &value, 1, NULL));
  return value;
}

static void gradients_are_numbers_everywhere(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {2, -2, 0}, most = 1.7e308;
  msq_context* context = make_context();
  msq_field* field;
  (void)state;
  assert_ok(msq_field_gradient(context, from, 3, to, 5, &field));
  for (int n = 0; n < 27; ++n) {
    const double p[3] = {most * (n % 3 - 1), most * (n / 3 % 3 - 1), most * (n / 9 - 1)};
    const double value = value_at(context, field, p);
    assert_true(value >= 3 && value <= 5);
  }
  msq_field_release(field);
  msq_context_release(context);
}

static void distances_of_a_field_fit_a_float(void** state) {
  const double center[3] = {0, 0, 0};
  msq_context* context = make_context();
  msq_shape *large, *small;
  msq_shape_distance_field_def def;
  const double curve[] = {0, 0, 1, 1};
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 1e60, &large));
  assert_ok(msq_shape_from_sphere(context, center, 1, &small));
  assert_ok(msq_shape_distance_field_def_init(&def, sizeof def));
  def.curve = curve;
  def.curve_count = 2;
  def.shape = large;
  def.step = 1e59;
  assert_makes_nothing(msq_field, msq_field_shape_distance(context, &def, &made, NULL),
                       MSQ_E_ARGUMENT, "a step of 1e+59");
  def.shape = small;
  def.step = 1e39;
  assert_makes_nothing(msq_field, msq_field_shape_distance(context, &def, &made, NULL),
                       MSQ_E_ARGUMENT, "a step of 1e+39");
  msq_shape_release(large);
  msq_shape_release(small);
  msq_context_release(context);
}

/* A field of distances needs a tree of a mesh's triangles. What has none exceeds the limit when it
 * is made, not in the middle of a query. */
static void trees_of_distance_fields_are_built_with_them(void** state) {
  const double curve[] = {0, 0.1, 1, 0.2};
  uint64_t refused = 0, made_count = 0;
  (void)state;
  for (uint64_t limit = 1 << 12; limit < (uint64_t)1 << 20; limit += limit / 4) {
    msq_context* context = make_context_of(1, 0, limit);
    msq_shape_distance_field_def def;
    msq_shape* cube = make_cube_mesh(context);
    msq_field* field = (msq_field*)untouched();
    assert_ok(msq_shape_distance_field_def_init(&def, sizeof def));
    def.shape = cube;
    def.curve = curve;
    def.curve_count = 2;
    const msq_status status = msq_field_shape_distance(context, &def, &field, NULL);
    if (status == MSQ_OK) {
      const double p[3] = {0.5, 0.5, 0.5};
      const uint64_t held = memory_of(context).bytes;
      (void)value_at(context, field, p);
      assert_int_equal(memory_of(context).bytes, held);
      msq_field_release(field);
      ++made_count;
    } else {
      assert_int_equal(status, MSQ_E_LIMIT);
      assert_ptr_equal(field, untouched());
      ++refused;
    }
    msq_shape_release(cube);
    msq_context_release(context);
  }
  assert_true(made_count > 0);
  print_message("refused at %llu limits\n", (unsigned long long)refused);
}

enum { grid_side = 200, grid_samples = grid_side * grid_side * grid_side };

/* A box, and a placed mesh that no sample of the grid's first layers comes near, in a context with
 * this memory limit. */
static msq_status ask_box_and_mesh(uint64_t limit, uint8_t* inside) {
  const double matrix[12] = {0, -1, 0, 4, 1, 0, 0, 0, 0, 0, 1, 100};
  const msq_points_def grid = grid_points(0, 120, grid_side);
  msq_context* context = make_context_of(1, 0, limit);
  msq_shape *cube = make_cube_mesh(context), *placed;
  msq_model *parts[2], *both;
  assert_ok(msq_shape_placed(cube, matrix, &placed));
  parts[0] = make_model(context, make_box(context), NULL, NULL);
  parts[1] = make_model(context, placed, NULL, NULL);
  assert_ok(msq_model_regions(context, (const msq_model* const*)parts, 2, &both));
  memset(inside, 2, grid_samples);
  const msq_status status = msq_set_membership(both, &grid, NULL, inside, grid_samples, NULL);
  msq_model_release(both);
  for (int i = 0; i < 2; ++i) msq_model_release(parts[i]);
  msq_shape_release(cube);
  msq_context_release(context);
  return status;
}

/* The triangles of a placed mesh are placed before the first sample is answered. */
static void rows_are_prepared_before_results(void** state) {
  static uint8_t inside[grid_samples];
  uint64_t refused = 1 << 12, answered = (uint64_t)1 << 30;
  (void)state;
  while (answered - refused > 1) {
    const uint64_t limit = refused + (answered - refused) / 2;
    const msq_status status = ask_box_and_mesh(limit, inside);
    if (status == MSQ_OK) {
      answered = limit;
      continue;
    }
    assert_int_equal(status, MSQ_E_LIMIT);
    assert_filled(inside, sizeof inside, 2);
    refused = limit;
  }
}

static msq_context* let_go;

static int32_t half_space(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)user;
  for (uint64_t i = 0; i < count; ++i) inside[i] = points[3 * i] < 0;
  if (let_go) msq_context_release(let_go);
  let_go = NULL;
  return 0;
}

static int32_t distance_to_it(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  for (uint64_t i = 0; i < count; ++i) values[i] = points[3 * i];
  if (let_go) msq_context_release(let_go);
  let_go = NULL;
  return 0;
}

/* The last reference to the context goes in a callback of the shape whose distances are sampled. */
static void contexts_may_go_in_callbacks(void** state) {
  const double curve[] = {0, 0, 1, 1};
  msq_context* context = make_context();
  msq_host_shape_def def;
  msq_shape_distance_field_def of;
  msq_shape* shape;
  msq_field* field;
  (void)state;
  assert_ok(msq_host_shape_def_init(&def, sizeof def));
  def.inside = half_space;
  def.distance = distance_to_it;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = -1;
    def.max[axis] = 1;
  }
  assert_ok(msq_shape_from_host(context, &def, &shape));
  assert_ok(msq_shape_distance_field_def_init(&of, sizeof of));
  of.shape = shape;
  of.step = 0.25;
  of.curve = curve;
  of.curve_count = 2;
  let_go = context;
  assert_ok(msq_field_shape_distance(context, &of, &field, NULL));
  assert_null(let_go);
  msq_field_release(field);
  msq_shape_release(shape);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(samples_far_away_are_refused),
      cmocka_unit_test(grids_may_be_far_larger_than_the_shape),
      cmocka_unit_test(shapes_are_counted_with_repetition),
      cmocka_unit_test(boxes_of_too_many_cells_are_refused),
      cmocka_unit_test(cell_sizes_of_a_fill_stay_numbers),
      cmocka_unit_test(gradients_are_numbers_everywhere),
      cmocka_unit_test(distances_of_a_field_fit_a_float),
      cmocka_unit_test(trees_of_distance_fields_are_built_with_them),
      cmocka_unit_test(rows_are_prepared_before_results),
      cmocka_unit_test(contexts_may_go_in_callbacks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
