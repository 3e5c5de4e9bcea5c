/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static const double low[3] = {-1, 2, 0.5}, high[3] = {3, 2.5, 8};

static void boundary_is_inside(void** state) {
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_box(context, low, high, &shape));
  msq_model* model = make_shape_model(context, shape);
  /* Each coordinate just below, at, between, at and just above the box's. */
  for (int i = 0; i < 125; ++i) {
    double point[3];
    int wanted = 1;
    for (int axis = 0, rest = i; axis < 3; ++axis, rest /= 5) {
      const double choices[5] = {nextafter(low[axis], -INFINITY), low[axis],
                                 (low[axis] + high[axis]) / 2, high[axis],
                                 nextafter(high[axis], INFINITY)};
      point[axis] = choices[rest % 5];
      if (rest % 5 == 0 || rest % 5 == 4) wanted = 0;
    }
    assert_int_equal(is_inside(model, point[0], point[1], point[2]), wanted);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void report_has_its_measures(void** state) {
  msq_context* context = make_context();
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_box(context, low, high, &shape));
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 0);
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(report.min[axis] == low[axis]);
    assert_true(report.max[axis] == high[axis]);
  }
  assert_true(report.volume == 15);
  assert_true(report.area == 2 * (4 * 0.5 + 0.5 * 7.5 + 7.5 * 4));
  assert_int_equal(report.vertices + report.triangles + report.open_edges, 0);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void null_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  (void)state;
  assert_makes_nothing(msq_shape, msq_shape_from_box(NULL, low, high, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_box(context, NULL, high, &made), MSQ_E_ARGUMENT,
                       "min is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_box(context, low, NULL, &made), MSQ_E_ARGUMENT,
                       "max is NULL");
  assert_refused(msq_shape_from_box(context, low, high, NULL), MSQ_E_ARGUMENT, "shape is NULL");
  msq_context_release(context);
}

static void corners_that_are_not_finite_are_refused(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (int which = 0; which < 3; ++which)
    for (int axis = 0; axis < 3; ++axis) {
      double corner[3] = {0, 0, 0};
      corner[axis] = not_finite(which);
      assert_makes_nothing(msq_shape, msq_shape_from_box(context, corner, high, &made),
                           MSQ_E_ARGUMENT, which == 0 ? "nan" : "inf");
      assert_message_has("min");
      assert_makes_nothing(msq_shape, msq_shape_from_box(context, low, corner, &made),
                           MSQ_E_ARGUMENT, which == 0 ? "nan" : "inf");
      assert_message_has("max");
    }
  msq_context_release(context);
}

static void min_must_be_less_than_max(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (int axis = 0; axis < 3; ++axis)
    for (int is_equal = 0; is_equal < 2; ++is_equal) {
      double min[3] = {1, 1, 1}, max[3] = {2, 2, 2};
      char text[16];
      min[axis] = is_equal ? 2 : 2.75;
      snprintf(text, sizeof text, "min[%d]", axis);
      assert_makes_nothing(msq_shape, msq_shape_from_box(context, min, max, &made), MSQ_E_ARGUMENT,
                           text);
      assert_message_has(is_equal ? "is 2 " : "2.75");
    }
  msq_context_release(context);
}

static void box_too_large_to_measure_is_refused(void** state) {
  const double min[3] = {-1.5e308, 0, 0}, max[3] = {1.5e308, 1, 1};
  msq_context* context = make_context();
  (void)state;
  assert_makes_nothing(msq_shape, msq_shape_from_box(context, min, max, &made), MSQ_E_ARGUMENT,
                       "too large");
  msq_context_release(context);
}

/* The lower corner and each side. */
static void sizes_have_limits(void** state) {
  const double most = 1e75, beyond = 1.0001e75;
  msq_context* context = make_context();
  (void)state;
  for (int axis = 0; axis < 3; ++axis) {
    double min[3] = {0, 0, 0}, max[3] = {1, 1, 1};
    msq_shape* shape;
    min[axis] = -most;
    max[axis] = 0;
    assert_ok(msq_shape_from_box(context, min, max, &shape));
    msq_shape_release(shape);
    min[axis] = most;
    max[axis] = 2 * most;
    assert_ok(msq_shape_from_box(context, min, max, &shape));
    msq_shape_release(shape);
    min[axis] = -0.5 * most;
    max[axis] = 0.5002 * most;
    assert_makes_nothing(msq_shape, msq_shape_from_box(context, min, max, &made), MSQ_E_ARGUMENT,
                         "the limit is 1e+75");
    assert_message_has("1.0002e+75");
    min[axis] = -beyond;
    max[axis] = -most;
    assert_makes_nothing(msq_shape, msq_shape_from_box(context, min, max, &made), MSQ_E_ARGUMENT,
                         "-1.0001e+75");
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),
      cmocka_unit_test(report_has_its_measures),
      cmocka_unit_test(null_arguments_are_refused),
      cmocka_unit_test(corners_that_are_not_finite_are_refused),
      cmocka_unit_test(min_must_be_less_than_max),
      cmocka_unit_test(box_too_large_to_measure_is_refused),
      cmocka_unit_test(sizes_have_limits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
