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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boundary_is_inside),
      cmocka_unit_test(slanted_cylinder_has_its_points),
      cmocka_unit_test(report_has_its_measures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
