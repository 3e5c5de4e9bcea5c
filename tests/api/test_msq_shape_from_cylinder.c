/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static msq_model* make_cylinder(msq_context* context, const double from[3], const double to[3],
                                double radius) {
  msq_shape* shape;
  assert_ok(msq_shape_from_cylinder(context, from, to, radius, &shape));
  return make_shape_model(context, shape);
}

static void boundary_is_inside(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 8};
  msq_context* context = make_context();
  msq_model* model = make_cylinder(context, from, to, 5);
  (void)state;
  assert_int_equal(is_inside(model, 0, 0, 0), 1); /* the flat ends, up to their rims */
  assert_int_equal(is_inside(model, 3, 4, 0), 1);
  assert_int_equal(is_inside(model, 3, 4, 8), 1);
  assert_int_equal(is_inside(model, 5, 0, 4), 1);
  assert_int_equal(is_inside(model, 0, -5, 4), 1);
  assert_int_equal(is_inside(model, 0, 0, nextafter(8, 9)), 0);
  assert_int_equal(is_inside(model, 0, 0, -5e-324), 0);
  assert_int_equal(is_inside(model, 5 + 1e-9, 0, 4), 0);
  assert_int_equal(is_inside(model, 4, 4, 4), 0);
  msq_model_release(model);
  msq_context_release(context);
}

static void slanted_cylinder_has_its_points(void** state) {
  const double from[3] = {1, 2, -1}, to[3] = {3, 1, 2};
  const double axis[3] = {2, -1, 3}, radius = 0.75, squared = 14;
  msq_context* context = make_context();
  msq_model* model = make_cylinder(context, from, to, radius);
  uint64_t random = 7;
  (void)state;
  for (size_t i = 0; i < test_count(3000); ++i) {
    double p[3], along = 0, across = 0;
    for (int a = 0; a < 3; ++a) {
      p[a] = random_between(&random, -2, 4);
      along += (p[a] - from[a]) * axis[a] / squared;
    }
    for (int a = 0; a < 3; ++a) {
      const double d = p[a] - from[a] - along * axis[a];
      across += d * d;
    }
    across = sqrt(across);
    if (fabs(along) < 1e-9 || fabs(along - 1) < 1e-9 || fabs(across - radius) < 1e-9) continue;
    assert_int_equal(is_inside(model, p[0], p[1], p[2]), along > 0 && along < 1 && across < radius);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void report_has_its_measures(void** state) {
  const double pi = 3.14159265358979323846;
  const double from[3] = {0, 0, 1}, to[3] = {0, 0, 4};
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_cylinder(context, from, to, 2, &shape));
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 0);
  assert_near(report.min[0], -2, 1e-9);
  assert_near(report.max[1], 2, 1e-9);
  assert_near(report.min[2], 1, 1e-9);
  assert_near(report.max[2], 4, 1e-9);
  assert_near(report.volume, pi * 4 * 3, 1e-12);
  assert_near(report.area, 2 * pi * 2 * 3 + 2 * pi * 4, 1e-12);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void wrong_arguments_are_refused(void** state) {
  const double from[3] = {1, 2, 3}, to[3] = {4, 5, 6};
  const double radii[] = {0, -2, NAN, INFINITY, 1e200};
  const char* texts[] = {"is 0;", "is -2;", "nan", "inf", "1e+200"};
  msq_context* context = make_context();
  (void)state;
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(NULL, from, to, 1, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, NULL, to, 1, &made),
                       MSQ_E_ARGUMENT, "from is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, from, NULL, 1, &made),
                       MSQ_E_ARGUMENT, "to is NULL");
  assert_refused(msq_shape_from_cylinder(context, from, to, 1, NULL), MSQ_E_ARGUMENT,
                 "shape is NULL");
  for (size_t i = 0; i < sizeof radii / sizeof radii[0]; ++i) {
    assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, from, to, radii[i], &made),
                         MSQ_E_ARGUMENT, texts[i]);
    assert_message_has("radius");
  }
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, from, from, 1, &made),
                       MSQ_E_ARGUMENT, "(1, 2, 3)");
  assert_message_has("differ");
  for (int which = 0; which < 3; ++which)
    for (int axis = 0; axis < 3; ++axis) {
      double point[3] = {0, 0, 0};
      point[axis] = not_finite(which);
      assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, point, to, 1, &made),
                           MSQ_E_ARGUMENT, "from is (");
      assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, from, point, 1, &made),
                           MSQ_E_ARGUMENT, "to is (");
    }
  msq_context_release(context);
}

/* Of coordinates, of the radius, and of the way from end to end along each axis. */
static void sizes_have_limits(void** state) {
  const double low[3] = {0, -0.6e75, 0}, high[3] = {0, 0.6e75, 0}, middle[3] = {0, 0.4e75, 0};
  const double far[3] = {1e75, 0, 0}, too_far[3] = {0, 0, 1.0001e75};
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_cylinder(context, low, middle, 1e75, &shape));
  msq_shape_release(shape);
  assert_ok(msq_shape_from_cylinder(context, middle, far, 1, &shape));
  msq_shape_release(shape);
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, low, high, 1, &made),
                       MSQ_E_ARGUMENT, "1.2e+75");
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, low, middle, 1.0001e75, &made),
                       MSQ_E_ARGUMENT, "the limit is 1e+75");
  assert_makes_nothing(msq_shape, msq_shape_from_cylinder(context, too_far, far, 1, &made),
                       MSQ_E_ARGUMENT, "the limit is 1e+75");
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),      cmocka_unit_test(slanted_cylinder_has_its_points),
      cmocka_unit_test(report_has_its_measures), cmocka_unit_test(wrong_arguments_are_refused),
      cmocka_unit_test(sizes_have_limits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
