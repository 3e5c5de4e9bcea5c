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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(surface_moves_by_the_distance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
