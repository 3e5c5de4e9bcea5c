/* SPDX-License-Identifier: Apache-2.0
 *
 * Directions for cameras. */
#ifndef MSQ_EXAMPLE_ORBIT_H
#define MSQ_EXAMPLE_ORBIT_H

#include <math.h>
#include <msq.h>

static inline double dot3(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline void cross3(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; ++i)
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
static inline void normalise3(double a[3]) {
  const double length = sqrt(dot3(a, a));
  for (int i = 0; i < 3; ++i) a[i] /= length;
}

/* The view from an eye at the azimuth (0 in front, at -y; 90 to the right, at +x) and elevation, in
 * degrees, towards what it looks at. */
static inline void orbit_direction(double azimuth, double elevation, double direction[3]) {
  const double degree = 0.017453292519943295;
  direction[0] = -cos(elevation * degree) * sin(azimuth * degree);
  direction[1] = cos(elevation * degree) * cos(azimuth * degree);
  direction[2] = -sin(elevation * degree);
}

/* A camera's own axes, of length 1. */
typedef struct frame_of_view {
  double right[3], up[3], forward[3];
} frame_of_view;

static inline frame_of_view frame_of(const msq_camera* camera) {
  frame_of_view f;
  for (int i = 0; i < 3; ++i) f.forward[i] = camera->target[i] - camera->eye[i];
  normalise3(f.forward);
  cross3(f.forward, camera->up, f.right);
  normalise3(f.right);
  cross3(f.right, f.forward, f.up);
  return f;
}

#endif
