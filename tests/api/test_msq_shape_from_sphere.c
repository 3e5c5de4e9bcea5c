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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),
      cmocka_unit_test(points_of_the_ball_and_no_others),
      cmocka_unit_test(report_has_its_measures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
