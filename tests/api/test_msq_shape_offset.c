/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_offset. */
#include "fixtures.h"

static double distance_of(const msq_model* model, const double p[3]) {
  double distance;
  assert_ok(msq_point_distance(model, p, NULL, &distance));
  return distance;
}

/* The points that lie no farther from the original; of a box known by a formula. */
static void surface_moves_by_the_distance(void** state) {
  msq_context* context = make_context();
  const double by[2] = {0.75, -0.75};
  msq_shape* shapes[2] = {make_box(context), make_cube_mesh(context)};
  (void)state;
  for (int kind = 0; kind < 2; ++kind) {
    for (int side = 0; side < 2; ++side) {
      msq_shape* shape;
      uint64_t random = 5;
      size_t held = 0;
      assert_ok(msq_shape_offset(shapes[kind], by[side], &shape));
      msq_model* model = make_shape_model(context, shape);
      for (size_t n = 0; n < test_count(5000); ++n) {
        double p[3], gap = 0, depth = INFINITY;
        for (int axis = 0; axis < 3; ++axis) {
          p[axis] = random_between(&random, -1, 5);
          const double beyond = fmax(0 - p[axis], p[axis] - 4);
          gap += fmax(beyond, 0) * fmax(beyond, 0);
          depth = fmin(depth, -beyond);
        }
        const double distance = depth >= 0 ? -depth : sqrt(gap);
        if (fabs(distance - by[side]) < 1e-9) continue;
        const int inside = is_inside(model, p[0], p[1], p[2]);
        assert_int_equal(inside, distance < by[side]);
        held += (size_t)inside;
        if (side == 0 && !inside) assert_near(distance_of(model, p), distance - by[side], 1e-9);
        if (side == 1 && inside) assert_near(distance_of(model, p), distance - by[side], 1e-9);
      }
      assert_true(held > test_count(5000) / 20);
      msq_model_release(model);
    }
    msq_shape_release(shapes[kind]);
  }
  msq_context_release(context);
}

static void wrong_arguments_are_refused(void** state) {
  msq_context* context = make_context();
  msq_shape *box = make_box(context), *both, *stretched;
  const double center[3] = {4, 2, 2}, stretch[12] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0};
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 2, &ball));
  const msq_shape* const members[2] = {box, ball};
  assert_ok(msq_shape_boolean(MSQ_BOOLEAN_UNION, members, 2, &both));
  assert_ok(msq_shape_placed(ball, stretch, &stretched));
#define REFUSED(shape, distance, status, text) \
  assert_makes_nothing(msq_shape, msq_shape_offset(shape, distance, &made), status, text)
  REFUSED(NULL, 1, MSQ_E_ARGUMENT, "original is NULL");
  REFUSED(box, 0, MSQ_E_ARGUMENT, "distance is 0");
  for (int which = 0; which < 3; ++which)
    REFUSED(box, not_finite(which), MSQ_E_ARGUMENT, "distance is ");
  REFUSED(box, -2.5, MSQ_E_ARGUMENT, "-2.5");
  REFUSED(box, 2e75, MSQ_E_ARGUMENT, "2e+75");
  REFUSED(both, -0.5, MSQ_E_UNSUPPORTED, "-0.5");
  REFUSED(stretched, 0.5, MSQ_E_UNSUPPORTED, "bound");
  assert_refused(msq_shape_offset(box, 1, NULL), MSQ_E_ARGUMENT, "shape is NULL");
#undef REFUSED
  msq_shape_release(stretched);
  msq_shape_release(both);
  msq_shape_release(ball);
  msq_shape_release(box);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(surface_moves_by_the_distance),
      cmocka_unit_test(wrong_arguments_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
