/* SPDX-License-Identifier: Apache-2.0
 * msq_point_distance. */
#include <float.h>

#include "definitions.h"

static const double inner[3] = {0.5, 0.5, 0.5};

static double distance_of(const msq_model* model, double x, double y, double z) {
  const double point[3] = {x, y, z};
  double distance = NAN;
  assert_ok(msq_point_distance(model, point, NULL, &distance));
  assert_true(isfinite(distance));
  assert_int_equal(distance <= 0, is_inside(model, x, y, z));
  return distance;
}

static void shapes_are_exact(void** state) {
  const double centre[3] = {2, 2, 2}, from[3] = {0, 2, 2}, to[3] = {4, 2, 2};
  msq_context* context = make_context();
  msq_shape *ball, *cylinder;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 2, &ball));
  assert_ok(msq_shape_from_cylinder(context, from, to, 1, &cylinder));
  msq_model* box = make_box_model(context);
  msq_model* mesh = make_shape_model(context, make_cube_mesh(context));
  msq_model* round[2] = {make_shape_model(context, ball), make_shape_model(context, cylinder)};
  msq_model* square[2] = {box, mesh};
  for (int i = 0; i < 2; ++i) {
    assert_near(distance_of(square[i], 2, 2, 1), -1, 1e-12);
    assert_near(distance_of(square[i], -3, 2, 1), 3, 1e-12);
    assert_near(distance_of(square[i], 7, -4, 2), 5, 1e-12);
    assert_near(distance_of(square[i], 6, 7, -6), 7, 1e-12);
    assert_near(distance_of(square[i], 0, 1, 1), 0, 1e-12); /* on a face */
  }
  assert_true(distance_of(box, 0, 1, 1) == 0);
  assert_true(!signbit(distance_of(box, 0, 1, 1)));
  assert_true(distance_of(mesh, 0, 1, 1) == 0); /* the least that rounding leaves */
  assert_true(!signbit(distance_of(mesh, 0, 1, 1)));
  assert_near(distance_of(round[0], 2, 2, 3.5), -0.5, 1e-12);
  assert_near(distance_of(round[0], 2, 5, 6), 3, 1e-12);
  assert_near(distance_of(round[1], 2, 2, 2.25), -0.75, 1e-12);
  assert_near(distance_of(round[1], 3.75, 2, 2.25), -0.25, 1e-12);
  assert_near(distance_of(round[1], 7, 2, 7), 5, 1e-12);
  for (int i = 0; i < 2; ++i) {
    msq_model_release(square[i]);
    msq_model_release(round[i]);
  }
  msq_context_release(context);
}

/* Cell 2, radius 0.5, struts along the axes through even coordinates. */
static void lattices_are_exact_outside(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_model(context, make_box(context),
                                make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5), NULL);
  (void)state;
  assert_near(distance_of(model, 1, 1, 1), sqrt(2) - 0.5, 1e-12);
  assert_near(distance_of(model, 1.2, 1, 2.25), sqrt(0.8 * 0.8 + 0.25 * 0.25) - 0.5, 1e-12);
  assert_near(distance_of(model, 1, 2.3, 1.9), sqrt(0.1) - 0.5, 1e-12);
  /* Outside the shape it is the shape that answers. */
  assert_near(distance_of(model, 1, 1, 4.001), 0.001, 1e-12);
  msq_model_release(model);
  msq_context_release(context);
}

/* The radius grows by 0.3 over a length of 4. */
static void fields_divide_by_their_slope(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 0};
  msq_context* context = make_context();
  msq_field* field;
  msq_lattice_def def;
  msq_structure* structure;
  (void)state;
  assert_ok(msq_field_gradient(context, from, 0.1, to, 0.4, &field));
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  set_cell(&def.grid, 2);
  def.radius.field = field;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  msq_field_release(field);
  msq_model* model = make_model(context, make_box(context), structure, NULL);
  assert_near(distance_of(model, 1, 1, 1), (sqrt(2) - 0.175) / 1.075, 1e-11);
  assert_near(distance_of(model, 3, 2, 2.1), (0.1 - 0.325) / 1.075, 1e-11);
  msq_model_release(model);
  msq_context_release(context);
}

/* Coarse lattice of cell 2, fine one of cell 0.5. */
static void scales_are_composed(void** state) {
  /* In both; in the coarse one alone; in the fine one alone. */
  const double points[3][3] = {{1.25, 0.02, 0.05}, {1.25, 0.25, 0.2}, {1.25, 1, 1}};
  const double scales[] = {0, 1, 3};
  const double shape[3] = {-0.02, -0.2, -1};
  msq_context* context = make_context();
  msq_model* parts[3];
  parts[0] = make_model(context, make_box(context), NULL, NULL);
  parts[1] = make_model(context, make_box_of(context, -100, 100),
                        make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5), NULL);
  parts[2] = make_model(context, make_box_of(context, -100, 100),
                        make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.5, 0.1), NULL);
  msq_model* model =
      make_model(context, make_box(context), make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5),
                 make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.5, 0.1));
  msq_query_def def;
  (void)state;
  assert_ok(msq_query_def_init(&def, sizeof def));
  for (int p = 0; p < 3; ++p) {
    double of[3], got;
    for (int s = 0; s < 3; ++s)
      of[s] = distance_of(parts[s], points[p][0], points[p][1], points[p][2]);
    assert_near(of[0], shape[p], 1e-12);
    for (int s = 0; s < 3; ++s) {
      double wanted = of[0];
      if (s < 2) wanted = of[1] > 0 ? of[1] : fmax(wanted, of[1]);
      if (s < 1 && of[1] <= 0) wanted = of[2] > 0 ? of[2] : fmax(wanted, of[2]);
      def.length_scale = scales[s];
      assert_ok(msq_point_distance(model, points[p], &def, &got));
      assert_true(got == wanted);
    }
  }
  for (int s = 0; s < 3; ++s) msq_model_release(parts[s]);
  msq_model_release(model);
  msq_context_release(context);
}

static void far_points_have_finite_distances(void** state) {
  const double far_away[] = {1e10, -1e300, DBL_MAX};
  msq_context* context = make_context();
  msq_model* models[3];
  (void)state;
  models[0] = make_lattice_model(context);
  models[1] = make_foam_model(context, MSQ_FOAM_AUTO);
  models[2] = make_shape_model(context, make_cube_mesh(context));
  for (int m = 0; m < 3; ++m) {
    for (int i = 0; i < 3; ++i) {
      const double away = fabs(far_away[i]);
      assert_near(distance_of(models[m], far_away[i], 1, 1), away, 1e-9 * away);
      assert_near(distance_of(models[m], 1, far_away[i], 1), away, 1e-9 * away);
      assert_near(distance_of(models[m], 1, 1, far_away[i]), away, 1e-9 * away);
      assert_true(distance_of(models[m], far_away[i], -far_away[i], far_away[i]) >= away);
    }
    msq_model_release(models[m]);
  }
  msq_context_release(context);
}

/* The tree of a mesh counts against the memory limit. */
static void trees_need_room(void** state) {
  msq_context* wide = make_context();
  msq_shape* shape = make_cube_mesh(wide);
  const uint64_t bytes = memory_of(wide).bytes, peak = memory_of(wide).peak_bytes;
  msq_model* model = make_shape_model(wide, shape);
  (void)state;
  assert_true(distance_of(model, 2, 2, 2) < 0);
  assert_true(memory_of(wide).bytes > bytes);
  const uint64_t needed = memory_of(wide).peak_bytes;
  msq_model_release(model);
  assert_int_equal(memory_of(wide).bytes, 0);
  msq_context_release(wide);

  assert_true(needed > peak);
  msq_context* narrow = make_context_of(1, 0, needed - 1);
  double distance = 77;
  model = make_shape_model(narrow, make_cube_mesh(narrow));
  for (int again = 0; again < 2; ++again) {
    assert_refused(msq_point_distance(model, inner, NULL, &distance), MSQ_E_LIMIT, "distances");
    assert_true(distance == 77);
  }
  assert_int_equal(memory_of(narrow).bytes, bytes);
  msq_model_release(model);
  msq_context_release(narrow);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shapes_are_exact),
      cmocka_unit_test(lattices_are_exact_outside),
      cmocka_unit_test(fields_divide_by_their_slope),
      cmocka_unit_test(scales_are_composed),
      cmocka_unit_test(far_points_have_finite_distances),
      cmocka_unit_test(trees_need_room),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
