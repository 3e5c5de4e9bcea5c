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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),
      cmocka_unit_test(report_has_its_measures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
