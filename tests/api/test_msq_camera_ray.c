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

static msq_status ask(void* env, void* camera) {
  const double position[2] = {1, 1};
  double out[6];
  (void)env;
  memset(out, struct_pattern, sizeof out);
  const msq_status status = msq_camera_ray((const msq_camera*)camera, 4, 4, position, out, out + 3);
  if (status != MSQ_OK) assert_filled(out, sizeof out, struct_pattern);
  return status;
}

static void honours_every_struct_size(void** state) {
  const msq_camera camera = downwards(MSQ_CAMERA_PERSPECTIVE);
  (void)state;
  check_def_sizes(&camera, sizeof camera, ask, NULL);
}

#define assert_camera_refused(change, text)                   \
  do {                                                        \
    msq_camera camera = downwards(projection);                \
    change;                                                   \
    assert_refused(ask(NULL, &camera), MSQ_E_ARGUMENT, text); \
  } while (0)

static void refuses_cameras_that_see_nothing(void** state) {
  int32_t projection = MSQ_CAMERA_ORTHOGRAPHIC;
  (void)state;
  assert_camera_refused(camera.projection = -1, "projection is -1");
  assert_camera_refused(camera.height = 0, "height is 0");
  assert_camera_refused(camera.height = -2, "height is -2");
  assert_camera_refused(camera.height = INFINITY, "height is inf");
  assert_camera_refused(camera.height = 1e308;
                        camera.eye[0] = camera.target[0] = 1.7e308, "not finite");
  for (; projection <= MSQ_CAMERA_PERSPECTIVE; ++projection) {
    for (int which = 0; which < 3; ++which) {
      assert_camera_refused(camera.eye[1] = not_finite(which), "eye is");
      assert_camera_refused(camera.target[1] = not_finite(which), "target is");
      assert_camera_refused(camera.up[1] = not_finite(which), "up is");
    }
    assert_camera_refused(camera.clip_near = -1, "clip_near is -1");
    assert_camera_refused(camera.clip_near = NAN, "clip_near is nan");
    assert_camera_refused(camera.clip_near = INFINITY, "clip_near is inf");
    assert_camera_refused(camera.clip_far = 0, "clip_far is 0");
    assert_camera_refused(camera.clip_far = NAN, "clip_far is nan");
    assert_camera_refused(camera.clip_near = camera.clip_far = 3, "clip_far is 3");
    assert_camera_refused(memcpy(camera.target, camera.eye, sizeof camera.eye),
                          "target - eye is (0, 0, 0)");
    assert_camera_refused(camera.up[1] = 1e-9, "along the view");
    assert_camera_refused(camera.up[1] = camera.up[2] = 0, "up is (0, 0, 0)");
  }
  projection = MSQ_CAMERA_PERSPECTIVE;
  assert_camera_refused(camera.field_of_view = 0, "field_of_view is 0");
  assert_camera_refused(camera.field_of_view = 180, "field_of_view is 180");
  assert_camera_refused(camera.field_of_view = NAN, "field_of_view is nan");
  /* What the projection has no use for may be anything. */
  msq_camera camera = downwards(MSQ_CAMERA_PERSPECTIVE);
  camera.height = -1;
  assert_ok(ask(NULL, &camera));
}

static void refuses_pictures_and_positions(void** state) {
  const msq_camera camera = downwards(MSQ_CAMERA_PERSPECTIVE);
  const double good[2] = {1, 1}, bad[2] = {1, INFINITY};
  double origin[3], direction[3];
  (void)state;
  assert_refused(msq_camera_ray(NULL, 4, 4, good, origin, direction), MSQ_E_ARGUMENT,
                 "camera is NULL");
  assert_refused(msq_camera_ray(&camera, 0, 4, good, origin, direction), MSQ_E_ARGUMENT,
                 "width is 0");
  assert_refused(msq_camera_ray(&camera, 4, 20000, good, origin, direction), MSQ_E_ARGUMENT,
                 "height is 20000; it must be from 1 to 16384");
  assert_refused(msq_camera_ray(&camera, 4, 4, NULL, origin, direction), MSQ_E_ARGUMENT,
                 "position is NULL");
  assert_refused(msq_camera_ray(&camera, 4, 4, bad, origin, direction), MSQ_E_ARGUMENT,
                 "position[1] is inf");
  assert_refused(msq_camera_ray(&camera, 4, 4, good, NULL, direction), MSQ_E_ARGUMENT,
                 "origin is NULL");
  assert_refused(msq_camera_ray(&camera, 4, 4, good, origin, NULL), MSQ_E_ARGUMENT,
                 "direction is NULL");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(begins_in_the_plane_of_the_eye),
      cmocka_unit_test(spreads_from_the_eye),
      cmocka_unit_test(honours_every_struct_size),
      cmocka_unit_test(refuses_cameras_that_see_nothing),
      cmocka_unit_test(refuses_pictures_and_positions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
