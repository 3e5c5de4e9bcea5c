/* SPDX-License-Identifier: Apache-2.0
 * msq_camera_fit: the model's box touches the picture's edges and nothing of it is beyond them. */
#include "cameras.h"

static const double box_min[3] = {-1, 2, 0.5}, box_max[3] = {3, 5, 1.5};

static msq_model* make_long_box_model(msq_context* context) {
  msq_shape* box;
  assert_ok(msq_shape_from_box(context, box_min, box_max, &box));
  return make_model(context, box, NULL, NULL);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(double v[3]) {
  const double size = sqrt(dot(v, v));
  for (int axis = 0; axis < 3; ++axis) v[axis] /= size;
}

/* Into the picture: right and up from its middle, its edges being at -1 and 1, and depth. */
static void project(const msq_camera* camera, double aspect, const double point[3], double out[3]) {
  double forward[3], right[3], up[3], from_eye[3];
  for (int axis = 0; axis < 3; ++axis) {
    forward[axis] = camera->target[axis] - camera->eye[axis];
    from_eye[axis] = point[axis] - camera->eye[axis];
  }
  make_unit(forward);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    right[axis] = forward[b] * camera->up[c] - forward[c] * camera->up[b];
  }
  make_unit(right);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    up[axis] = right[b] * forward[c] - right[c] * forward[b];
  }
  out[2] = dot(from_eye, forward);
  const double half = camera->projection == MSQ_CAMERA_ORTHOGRAPHIC
                          ? camera->height / 2
                          : out[2] * tan(camera->field_of_view / 360 * acos(-1));
  out[0] = dot(from_eye, right) / (half * aspect);
  out[1] = dot(from_eye, up) / half;
}

static void fits_the_box(void** state) {
  static const double directions[5][3] = {
      {1, 0, 0}, {-0.3, 0.5, -0.2}, {1, 1, 1}, {-1e-3, 2e-4, 1e-3}, {0, -4, 0.1}};
  static const uint32_t sizes[3][2] = {{640, 480}, {16384, 100}, {1, 7}};
  msq_context* context = make_context();
  msq_model* model = make_long_box_model(context);
  (void)state;
  for (int32_t projection = 0; projection < 2; ++projection)
    for (int d = 0; d < 5; ++d)
      for (int s = 0; s < 3; ++s) {
        msq_camera camera;
        assert_ok(msq_camera_init(&camera, sizeof camera));
        camera.projection = projection;
        camera.field_of_view = 65;
        camera.clip_near = 0.25;
        camera.clip_far = 99;
        assert_ok(msq_camera_fit(model, directions[d], NULL, sizes[s][0], sizes[s][1], &camera));
        double most = 0, nearest = INFINITY;
        for (int corner = 0; corner < 8; ++corner) {
          double point[3], seen[3];
          for (int axis = 0; axis < 3; ++axis)
            point[axis] = corner >> axis & 1 ? box_max[axis] : box_min[axis];
          project(&camera, (double)sizes[s][0] / sizes[s][1], point, seen);
          most = fmax(most, fmax(fabs(seen[0]), fabs(seen[1])));
          nearest = fmin(nearest, seen[2]);
        }
        assert_near(most, 1, 1e-12);
        assert_true(nearest > 0);
        assert_true(camera.projection == projection && camera.field_of_view == 65);
        assert_true(camera.clip_near == 0.25 && camera.clip_far == 99);
        assert_true(camera.height > 0);
        for (int axis = 0; axis < 3; ++axis)
          assert_near(camera.target[axis], (box_min[axis] + box_max[axis]) / 2, 1e-12);
      }
  msq_model_release(model);
  msq_context_release(context);
}

static void looks_upwards_as_told(void** state) {
  const double along[3] = {0.01, 0, -1}, aside[3] = {0.1, 0, -1}, up[3] = {0, 0.5, 0};
  msq_context* context = make_context();
  msq_model* model = make_long_box_model(context);
  msq_camera camera;
  (void)state;
  assert_ok(msq_camera_init(&camera, sizeof camera));
  assert_true(camera.up[0] == 0 && camera.up[1] == 0 && camera.up[2] == 1);
  assert_ok(msq_camera_fit(model, along, NULL, 10, 10, &camera));
  assert_true(camera.up[1] == 1 && camera.up[2] == 0);
  assert_ok(msq_camera_fit(model, aside, NULL, 10, 10, &camera));
  assert_true(camera.up[1] == 0 && camera.up[2] == 1);
  assert_ok(msq_camera_fit(model, aside, up, 10, 10, &camera));
  assert_true(camera.up[1] == 0.5 && camera.up[2] == 0);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fits_the_box),
      cmocka_unit_test(looks_upwards_as_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
