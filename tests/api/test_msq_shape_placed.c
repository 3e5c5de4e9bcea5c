/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_placed. */
#include "fixtures.h"

/* A quarter turn about z, twice as large, mirrored in z, and moved: all of it exact. */
static const double exact[12] = {0, -2, 0, 8, 2, 0, 0, -3, 0, 0, -2, 5};

static void membership_is_that_of_the_mapped_point(void** state) {
  msq_context* context = make_context();
  msq_shape *original = make_cube_mesh(context), *shape;
  uint64_t random = 1;
  size_t held = 0;
  (void)state;
  assert_ok(msq_shape_placed(original, exact, &shape));
  msq_model* wanted = make_shape_model(context, original); /* releases it */
  msq_model* model = make_shape_model(context, shape);
  double min[3], max[3];
  assert_ok(msq_model_bounds(model, min, max));
  for (size_t i = 0; i < test_count(5000); ++i) {
    double q[3], p[3];
    for (int axis = 0; axis < 3; ++axis) q[axis] = random_between(&random, -1, 5);
    if (i % 4 == 0) q[i % 3] = (double)(i % 5); /* on faces */
    for (int axis = 0; axis < 3; ++axis)        /* so that the map is exact */
      q[axis] = round(q[axis] * 1048576) / 1048576;
    for (int axis = 0; axis < 3; ++axis) {
      const double* row = exact + (size_t)axis * 4;
      p[axis] = row[0] * q[0] + row[1] * q[1] + row[2] * q[2] + row[3];
    }
    const int inside = is_inside(model, p[0], p[1], p[2]);
    double of_original, of_placed;
    assert_int_equal(inside, is_inside(wanted, q[0], q[1], q[2]));
    if (inside)
      for (int axis = 0; axis < 3; ++axis)
        assert_true(p[axis] >= min[axis] && p[axis] <= max[axis]);
    held += (size_t)inside;
    assert_ok(msq_point_distance(wanted, q, NULL, &of_original));
    assert_ok(msq_point_distance(model, p, NULL, &of_placed));
    assert_near(of_placed, 2 * of_original, 1e-11);
  }
  assert_true(held > test_count(5000) / 20);
  msq_model_release(model);
  msq_model_release(wanted);
  msq_context_release(context);
}

static void report_is_that_of_the_instance(void** state) {
  msq_context* context = make_context();
  msq_shape *original = make_cube_mesh(context), *shape, *sheared;
  const double shear[12] = {1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  (void)state;
  assert_ok(msq_shape_placed(original, exact, &shape));
  assert_ok(msq_shape_placed(original, shear, &sheared));
  const msq_shape_report before = info_of(original), after = info_of(shape);
  const msq_shape_report of_sheared = info_of(sheared);
  assert_int_equal(after.is_mesh, 1);
  assert_int_equal(after.triangles, before.triangles);
  assert_near(after.volume, 8 * before.volume, 1e-9);
  assert_near(after.area, 4 * before.area, 1e-9);
  assert_near(of_sheared.volume, before.volume, 1e-9);
  assert_true(isnan(of_sheared.area));
  msq_shape_release(sheared);
  msq_shape_release(shape);
  msq_shape_release(original);
  msq_context_release(context);
}

/* Along (1, 2, 2) nothing grows, along (2, 1, -2) lengths become 3 times as large, along (2, -2, 1)
 * 6 times. The nearest points of the ellipsoid are on the first of these axes. */
static void distances_are_those_of_the_least_growth(void** state) {
  const double axes[3][3] = {{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}, growth[3] = {1, 3, 6};
  const double origin[3] = {0, 0, 0};
  double stretch[12] = {0};
  msq_context* context = make_context();
  msq_shape *ball, *shape;
  (void)state;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k) stretch[4 * i + j] += growth[k] * axes[k][i] * axes[k][j] / 9;
  assert_ok(msq_shape_from_sphere(context, origin, 3, &ball));
  assert_ok(msq_shape_placed(ball, stretch, &shape));
  msq_model* model = make_shape_model(context, shape); /* releases it */
  for (double t = 1.25; t < 4; t += 0.25) {
    const double p[3] = {t, 2 * t, 2 * t};
    double distance;
    assert_ok(msq_point_distance(model, p, NULL, &distance));
    assert_near(distance, 3 * t - 3, 1e-9);
  }
  msq_model_release(model);
  msq_shape_release(ball);
  msq_context_release(context);
}

/* A scale can leave a skin in an instance, but not in a stretched one. */
static void skin_needs_equal_growth(void** state) {
  msq_context* context = make_context();
  msq_shape *original = make_cube_mesh(context), *shape, *stretched;
  const double stretch[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0};
  msq_scale_def scales[2] = {{0}};
  msq_model_def def;
  msq_model* model;
  (void)state;
  assert_ok(msq_shape_placed(original, exact, &shape));
  assert_ok(msq_shape_placed(original, stretch, &stretched));
  scales[0].shape = stretched;
  scales[1].structure = make_lattice(context);
  scales[1].skin.value = 0.1;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  assert_makes_nothing(msq_model, msq_model_create(context, &def, &made), MSQ_E_UNSUPPORTED,
                       "depth");
  scales[0].shape = shape;
  assert_ok(msq_model_create(context, &def, &model));
  /* Just under the side that was z = 4, now z = -3. */
  assert_int_equal(is_inside(model, 4.3, 1.3, -2.95), 1);
  msq_model_release(model);
  msq_structure_release((msq_structure*)scales[1].structure);
  msq_shape_release(stretched);
  msq_shape_release(shape);
  msq_shape_release(original);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(membership_is_that_of_the_mapped_point),
      cmocka_unit_test(report_is_that_of_the_instance),
      cmocka_unit_test(distances_are_those_of_the_least_growth),
      cmocka_unit_test(skin_needs_equal_growth),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
