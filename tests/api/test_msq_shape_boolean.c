/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_boolean. */
#include "fixtures.h"

/* The box from 0 to 4, the ball of radius 2 about (4, 2, 2), and the box from 1 to 3. */
static void make_shapes(msq_context* context, msq_shape* shapes[3]) {
  const double center[3] = {4, 2, 2};
  shapes[0] = make_box(context);
  assert_ok(msq_shape_from_sphere(context, center, 2, &shapes[1]));
  shapes[2] = make_box_of(context, 1, 3);
}

static void memberships_are_put_together(void** state) {
  msq_context* context = make_context();
  msq_shape *shapes[3], *made[3];
  msq_model *members[3], *models[3];
  uint64_t random = 3;
  size_t held[3] = {0};
  (void)state;
  make_shapes(context, shapes);
  for (int32_t i = 0; i < 3; ++i) {
    assert_ok(msq_shape_boolean(i + 1, (const msq_shape* const*)shapes, 3, &made[i]));
    assert_true(isnan(info_of(made[i]).volume) && isnan(info_of(made[i]).area));
  }
  for (int i = 0; i < 3; ++i) {
    members[i] = make_shape_model(context, shapes[i]);
    models[i] = make_shape_model(context, made[i]);
  }
  for (size_t n = 0; n < 5000; ++n) {
    double p[3], of[3], distance;
    int in[3];
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = n % 2 ? random_between(&random, -1, 7) : floor(random_between(&random, -1, 7));
    for (int i = 0; i < 3; ++i) {
      in[i] = is_inside(members[i], p[0], p[1], p[2]);
      assert_ok(msq_point_distance(members[i], p, NULL, &of[i]));
    }
    const int wanted[3] = {in[0] || in[1] || in[2], in[0] && in[1] && in[2],
                           in[0] && !in[1] && !in[2]};
    const double distances[3] = {fmin(of[0], fmin(of[1], of[2])), fmax(of[0], fmax(of[1], of[2])),
                                 fmax(of[0], fmax(-of[1], -of[2]))};
    for (int i = 0; i < 3; ++i) {
      assert_int_equal(is_inside(models[i], p[0], p[1], p[2]), wanted[i]);
      held[i] += (size_t)wanted[i];
      assert_ok(msq_point_distance(models[i], p, NULL, &distance));
      assert_true(wanted[i] ? distance <= 0 : distance > 0);
      assert_near(distance, distances[i], 1e-300);
    }
  }
  for (int i = 0; i < 3; ++i) {
    assert_true(held[i] > 20);
    msq_model_release(models[i]);
    msq_model_release(members[i]);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(memberships_are_put_together),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
