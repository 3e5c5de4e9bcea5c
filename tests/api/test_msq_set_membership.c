/* SPDX-License-Identifier: Apache-2.0
 * msq_points_def_init, msq_set_membership. Progress and cancelling: test_msq_job_*.c. Memory limit:
 * test_msq_context_memory.c. */
#include "arrays.h"

/* Asks for `few` answers; on failure none may be written. */
static msq_status ask(void* env, void* def) {
  uint8_t inside[few];
  memset(inside, struct_pattern, sizeof inside);
  const msq_status status = msq_set_membership((const msq_model*)env, (const msq_points_def*)def,
                                               NULL, inside, few, NULL);
  if (status != MSQ_OK) assert_filled(inside, sizeof inside, struct_pattern);
  return status;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_points_def def;
  (void)state;
  assert_ok(msq_points_def_init(&def, sizeof def));
  assert_int_equal(def.stride, 0);
  assert_int_equal(def.coordinate_type, MSQ_FLOAT64);
  assert_int_equal(def.count, 0);
  assert_null(def.coordinates);
}

/* ---- answers */

/* The answers are those of msq_point_membership; `coordinates` as msq sees them. */
static void assert_answers(const msq_model* model, const msq_points_def* def,
                           const double (*coordinates)[3], uint64_t count) {
  uint8_t* inside = (uint8_t*)malloc(count + 2);
  assert_non_null(inside);
  memset(inside, struct_pattern, count + 2);
  assert_ok(msq_set_membership(model, def, NULL, inside + 1, count, NULL));
  assert_int_equal(inside[0], struct_pattern);
  assert_int_equal(inside[count + 1], struct_pattern);
  for (uint64_t i = 0; i < count; ++i)
    assert_int_equal(inside[i + 1],
                     is_inside(model, coordinates[i][0], coordinates[i][1], coordinates[i][2]));
  free(inside);
}

static void arrays_have_any_type_and_stride(void** state) {
  const uint64_t doubles[] = {0, 24, 25, 31, 64}, floats[] = {0, 12, 13, 17, 32};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  (void)state;
  for (int i = 0; i < 5; ++i) {
    check_array(model, test_count(1000), MSQ_FLOAT64, doubles[i], assert_answers);
    check_array(model, test_count(1000), MSQ_FLOAT32, floats[i], assert_answers);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Work is divided among threads in chunks: counts about their borders. */
static void arrays_have_any_length(void** state) {
  const uint64_t counts[] = {1, 2, 4095, 4096, 4097, 12289};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  (void)state;
  for (int i = 0; i < 6; ++i) check_array(model, counts[i], MSQ_FLOAT64, 0, assert_answers);
  msq_model_release(model);
  msq_context_release(context);
}

static void every_kind_of_model_answers_arrays_as_points(void** state) {
  msq_context* context = make_context();
  (void)state;
  const double middle[3] = {2, 2, 2};
  msq_shape* ball;
  assert_ok(msq_shape_from_sphere(context, middle, 2, &ball));
  msq_model* models[] = {
    make_box_model(context),
    make_shape_model(context, make_cube_mesh(context)),
    make_shape_model(context, ball),
    make_foam_model(context, MSQ_FOAM_AUTO),
    make_foam_model(context, MSQ_FOAM_POINT),
    make_foam_model(context, MSQ_FOAM_METHOD_1),
    make_foam_model(context, MSQ_FOAM_DIRECT),
#if MSQ_WITH_CGAL
    make_foam_model(context, MSQ_FOAM_METHOD_2),
#endif
    make_model(context, make_cube_mesh(context), make_lattice(context),
               make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 0.5, 0.05)),
  };
  for (size_t i = 0; i < sizeof models / sizeof models[0]; ++i) {
    check_array(models[i], test_count(500), MSQ_FLOAT64, 0, assert_answers);
    msq_model_release(models[i]);
  }
  msq_context_release(context);
}

/* A grid of three different counts, so that every other order of the answers shows. */
static void check_grid(const msq_model* model) {
  const uint64_t n[3] = {70, 9, 5};
  const uint64_t count = 70 * 9 * 5;
  double(*seen)[3] = (double(*)[3])malloc(count * sizeof *seen);
  msq_points_def def;
  assert_non_null(seen);
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = -0.2 - 0.01 * axis;
    def.spacing[axis] = 4.5 / (double)n[axis];
    def.counts[axis] = n[axis];
  }
  for (uint64_t k = 0; k < n[2]; ++k)
    for (uint64_t j = 0; j < n[1]; ++j)
      for (uint64_t i = 0; i < n[0]; ++i) {
        double* p = seen[i + n[0] * (j + n[1] * k)];
        p[0] = def.origin[0] + (double)i * def.spacing[0];
        p[1] = def.origin[1] + (double)j * def.spacing[1];
        p[2] = def.origin[2] + (double)k * def.spacing[2];
      }
  assert_answers(model, &def, (const double(*)[3])seen, count);
  free(seen);
}

static void grids_are_answered_x_first(void** state) {
  msq_context* context = make_context();
  const double from[3] = {0, 1, 0}, to[3] = {4, 3, 4};
  msq_shape* cylinder;
  (void)state;
  assert_ok(msq_shape_from_cylinder(context, from, to, 1.5, &cylinder));
  msq_model* models[] = {
    make_box_model(context),
    make_shape_model(context, make_cube_mesh(context)),
    make_shape_model(context, cylinder),
    make_lattice_model(context),
    make_foam_model(context, MSQ_FOAM_AUTO),
    make_foam_model(context, MSQ_FOAM_METHOD_1),
#if MSQ_WITH_CGAL
    make_foam_model(context, MSQ_FOAM_METHOD_2),
#endif
  };
  for (size_t i = 0; i < sizeof models / sizeof models[0]; ++i) {
    check_grid(models[i]);
    msq_model_release(models[i]);
  }
  msq_context_release(context);
}

static void grid_of_one_point_is_a_grid(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_points_def def;
  uint8_t inside = 77;
  (void)state;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = 0.5;
    def.spacing[axis] = 1;
    def.counts[axis] = 1;
  }
  assert_ok(msq_set_membership(model, &def, NULL, &inside, 1, NULL));
  assert_int_equal(inside, 1);
  msq_model_release(model);
  msq_context_release(context);
}

static void no_points_is_nothing_to_do(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_points_def def = array_of(NULL, 0);
  (void)state;
  assert_ok(msq_set_membership(model, &def, NULL, NULL, 0, NULL));
  msq_model_release(model);
  msq_context_release(context);
}

/* Nested lattices of cells 2 and 0.5: at each length scale the answers are those of the model that
 * has the resolved scales alone. */
static void finer_scales_are_solid_at_a_length_scale(void** state) {
  enum { side = 30, samples = side * side * side };
  const double scales[] = {0, 0.5, 0.50001, 2, 2.00001, INFINITY};
  const int resolved[] = {2, 2, 1, 1, 0, 0};
  const msq_points_def grid = grid_points(0, 4, side);
  uint8_t wanted[samples], got[samples];
  msq_context* context = make_context();
  msq_query_def query;
  (void)state;
  for (int s = 0; s < 6; ++s) {
    msq_structure* coarse = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5);
    msq_structure* fine = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0.5, 0.1);
    msq_structure_retain(coarse);
    msq_structure_retain(fine);
    msq_model* all = make_model(context, make_box(context), coarse, fine);
    msq_model* some = make_model(context, make_box(context), resolved[s] > 0 ? coarse : NULL,
                                 resolved[s] > 1 ? fine : NULL);
    if (resolved[s] < 1) msq_structure_release(coarse);
    if (resolved[s] < 2) msq_structure_release(fine);
    assert_ok(msq_query_def_init(&query, sizeof query));
    query.length_scale = scales[s];
    assert_ok(msq_set_membership(all, &grid, &query, got, samples, NULL));
    assert_ok(msq_set_membership(some, &grid, NULL, wanted, samples, NULL));
    assert_memory_equal(got, wanted, samples);
    msq_model_release(all);
    msq_model_release(some);
  }
  msq_context_release(context);
}

/* ---- what is refused */

static void points_that_are_not_finite_are_named(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  (void)state;
  for (int which = 0; which < 3; ++which)
    for (int axis = 0; axis < 3; ++axis) {
      double points[few][3];
      memcpy(points, few_points(), sizeof points);
      points[3][axis] = not_finite(which);
      msq_points_def def = array_of(points, few);
      assert_refused(ask(model, &def), MSQ_E_ARGUMENT, "point 3");
      assert_message_has(which == 0 ? "nan" : "inf");
    }
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(arrays_have_any_type_and_stride),
      cmocka_unit_test(arrays_have_any_length),
      cmocka_unit_test(every_kind_of_model_answers_arrays_as_points),
      cmocka_unit_test(grids_are_answered_x_first),
      cmocka_unit_test(grid_of_one_point_is_a_grid),
      cmocka_unit_test(no_points_is_nothing_to_do),
      cmocka_unit_test(finer_scales_are_solid_at_a_length_scale),
      cmocka_unit_test(points_that_are_not_finite_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
