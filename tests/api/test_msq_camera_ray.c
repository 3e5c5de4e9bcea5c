/* SPDX-License-Identifier: Apache-2.0
 * msq_camera_ray: where the rays of a picture begin and go. */
#include "cameras.h"

static void assert_vector(const double got[3], double x, double y, double z, double tolerance) {
  assert_near(got[0], x, tolerance);
  assert_near(got[1], y, tolerance);
  assert_near(got[2], z, tolerance);
}

/* From (1, 2, 10) down along z, y upwards: right is x. */
static msq_camera downwards(int32_t projection) {
  msq_camera camera = camera_at(projection, 1, 2, 10);
  camera.target[0] = 1;
  camera.target[1] = 2;
  camera.target[2] = 4;
  camera.up[1] = 3; /* of any length, and not normal to the view */
  camera.up[2] = -2;
  camera.height = 6;
  camera.field_of_view = 90;
  return camera;
}

static void begins_in_the_plane_of_the_eye(void** state) {
  const msq_camera camera = downwards(MSQ_CAMERA_ORTHOGRAPHIC);
  const double positions[3][2] = {{0, 0}, {6, 3}, {11.5, 5.5}};
  double origin[3], direction[3];
  (void)state;
  /* 12 x 6 pixels of 1 x 1. */
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[0], origin, direction));
  assert_vector(origin, 1 - 6, 2 + 3, 10, 1e-14);
  assert_vector(direction, 0, 0, -1, 0);
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[1], origin, direction));
  assert_vector(origin, 1, 2, 10, 0);
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[2], origin, direction));
  assert_vector(origin, 1 + 5.5, 2 - 2.5, 10, 1e-14);
}

static void spreads_from_the_eye(void** state) {
  const msq_camera camera = downwards(MSQ_CAMERA_PERSPECTIVE);
  const double positions[3][2] = {{0, 0}, {6, 3}, {12, 4.5}};
  double origin[3], direction[3];
  (void)state;
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[0], origin, direction));
  assert_vector(origin, 1, 2, 10, 0);
  assert_vector(direction, -2, 1, -1, 1e-14); /* of length 1 along the view */
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[1], origin, direction));
  assert_vector(direction, 0, 0, -1, 0);
  assert_ok(msq_camera_ray(&camera, 12, 6, positions[2], origin, direction));
  assert_vector(direction, 2, -0.5, -1, 1e-14);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(begins_in_the_plane_of_the_eye),
      cmocka_unit_test(spreads_from_the_eye),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
