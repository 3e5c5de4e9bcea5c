/* SPDX-License-Identifier: Apache-2.0 */
#include "pose.h"

#include "orbit.h"

static const double FIELD_OF_VIEW = 40;

void pose_reset(pose* p, const double min[3], const double max[3]) {
  const double size[3] = {max[0] - min[0], max[1] - min[1], max[2] - min[2]};
  const int* w = p->window;
  p->azimuth = 32;
  p->elevation = 28;
  p->diagonal = sqrt(dot3(size, size));
  p->height = 1.02 * p->diagonal * w[1] / (w[0] < w[1] ? w[0] : w[1]);
  for (int a = 0; a < 3; ++a) p->target[a] = 0.5 * (min[a] + max[a]);
}

msq_status pose_camera(const pose* p, msq_camera* camera) {
  const msq_status status = msq_camera_init(camera, sizeof *camera);
  if (status != MSQ_OK) return status;
  double direction[3], back = 1.5 * p->diagonal;
  orbit_direction(p->azimuth, p->elevation, direction);
  camera->height = p->height;
  camera->up[1] = 0;
  camera->up[2] = 1;
  if (p->is_perspective) {
    camera->projection = MSQ_CAMERA_PERSPECTIVE;
    camera->field_of_view = FIELD_OF_VIEW;
    back = 0.5 * p->height / tan(0.5 * FIELD_OF_VIEW * 0.017453292519943295);
  }
  for (int a = 0; a < 3; ++a) {
    camera->target[a] = p->target[a];
    camera->eye[a] = p->target[a] - back * direction[a];
  }
  return MSQ_OK;
}

void pose_turn(pose* p, double dx, double dy) {
  p->azimuth -= 0.4 * dx;
  p->elevation = fmin(fmax(p->elevation + 0.4 * dy, -89), 89);
}

msq_status pose_pan(pose* p, double dx, double dy) {
  msq_camera camera;
  const msq_status status = pose_camera(p, &camera);
  if (status != MSQ_OK) return status;
  const frame_of_view f = frame_of(&camera);
  const double unit = p->height / p->window[1];
  for (int a = 0; a < 3; ++a) p->target[a] += unit * (dy * f.up[a] - dx * f.right[a]);
  return MSQ_OK;
}

msq_status pose_zoom(pose* p, double notches, int x, int y) {
  const double factor = pow(0.85, notches), height = p->height * factor;
  if (height < 1e-4 * p->diagonal || height > 10 * p->diagonal) return MSQ_OK;
  /* What is under the pixel stays there. */
  const double dx = x - 0.5 * p->window[0], dy = y - 0.5 * p->window[1];
  const msq_status status = pose_pan(p, dx * (factor - 1), dy * (factor - 1));
  p->height = height;
  return status;
}
