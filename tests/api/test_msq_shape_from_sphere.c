/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static const double center[3] = {1, -2, 3};

static msq_model* make_ball(msq_context* context, double radius) {
  msq_shape* shape;
  assert_ok(msq_shape_from_sphere(context, center, radius, &shape));
  return make_shape_model(context, shape);
}

static void boundary_is_inside(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_ball(context, 5);
  (void)state;
  assert_int_equal(is_inside(model, 1, -2, 3), 1);
  assert_int_equal(is_inside(model, 6, -2, 3), 1);
  assert_int_equal(is_inside(model, 1, -7, 3), 1);
  assert_int_equal(is_inside(model, 1, -2, -2), 1);
  assert_int_equal(is_inside(model, 1 + 3, -2 + 4, 3), 1); /* 3, 4, 5 */
  assert_int_equal(is_inside(model, nextafter(6, 7), -2, 3), 0);
  assert_int_equal(is_inside(model, 1 + 3, -2 + nextafter(4, 5) + 1e-15, 3), 0);
  assert_int_equal(is_inside(model, 5, 2, 7), 0); /* in the box, out of the ball */
  msq_model_release(model);
  msq_context_release(context);
}

static void points_of_the_ball_and_no_others(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_ball(context, 1.25);
  uint64_t random = 1;
  (void)state;
  for (size_t i = 0; i < test_count(2000); ++i) {
    double d[3], distance;
    for (int axis = 0; axis < 3; ++axis) d[axis] = random_between(&random, -1.5, 1.5);
    distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (fabs(distance - 1.25) < 1e-9) continue;
    assert_int_equal(is_inside(model, center[0] + d[0], center[1] + d[1], center[2] + d[2]),
                     distance < 1.25);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void report_has_its_measures(void** state) {
  const double pi = 3.14159265358979323846;
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 2, &shape));
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 0);
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(report.min[axis] == center[axis] - 2);
    assert_true(report.max[axis] == center[axis] + 2);
  }
  assert_near(report.volume, 4.0 / 3 * pi * 8, 1e-12);
  assert_near(report.area, 4 * pi * 4, 1e-12);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void wrong_arguments_are_refused(void** state) {
  const double radii[] = {0, -1, NAN, INFINITY, -INFINITY, 1e200};
  const char* texts[] = {"is 0;", "is -1;", "nan", "inf", "-inf", "1e+200"};
  msq_context* context = make_context();
  (void)state;
  assert_makes_nothing(msq_shape, msq_shape_from_sphere(NULL, center, 1, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, NULL, 1, &made), MSQ_E_ARGUMENT,
                       "center is NULL");
  assert_refused(msq_shape_from_sphere(context, center, 1, NULL), MSQ_E_ARGUMENT, "shape is NULL");
  for (size_t i = 0; i < sizeof radii / sizeof radii[0]; ++i) {
    assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, center, radii[i], &made),
                         MSQ_E_ARGUMENT, texts[i]);
    assert_message_has("radius");
  }
  for (int which = 0; which < 3; ++which)
    for (int axis = 0; axis < 3; ++axis) {
      double point[3] = {0, 0, 0};
      point[axis] = not_finite(which);
      assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, point, 1, &made),
                           MSQ_E_ARGUMENT, "center");
      assert_message_has("finite");
    }
  msq_context_release(context);
}

static void sizes_have_limits(void** state) {
  const double far[3] = {0, -1e75, 1e75}, too_far[3] = {0, 0, -1.0001e75};
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, far, 1e75, &shape));
  msq_shape_release(shape);
  assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, center, 1.0001e75, &made),
                       MSQ_E_ARGUMENT, "the limit is 1e+75");
  assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, too_far, 1, &made), MSQ_E_ARGUMENT,
                       "the limit is 1e+75");
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),      cmocka_unit_test(points_of_the_ball_and_no_others),
      cmocka_unit_test(report_has_its_measures), cmocka_unit_test(wrong_arguments_are_refused),
      cmocka_unit_test(sizes_have_limits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
