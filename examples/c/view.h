/* SPDX-License-Identifier: Apache-2.0
 *
 * An orthographic view with a depth buffer, for drawing small discs. */
#ifndef MSQ_EXAMPLE_VIEW_H
#define MSQ_EXAMPLE_VIEW_H

#include <float.h>
#include <stdint.h>

#define VIEW_EMPTY (-FLT_MAX) /* depth where nothing was drawn */

typedef struct vec {
  double x, y, z;
} vec;

static inline vec make_vec(double x, double y, double z) {
  const vec v = {x, y, z};
  return v;
}
static inline double dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline vec scaled_sum(double s, vec a, double t, vec b) {
  return make_vec(s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z);
}

typedef struct view {
  vec right, up, toward; /* orthonormal; toward points to the eye */
  double scale;          /* pixels a unit of length */
  double left, top;      /* of the picture, along right and up */
  int width, height;     /* pixels */
  float* depth;          /* along toward: larger is nearer */
  int8_t (*normal)[3];   /* along right, up, toward, of length 127; NULL where not kept */
} view;

/* A view of the box from the origin to size, no wider or higher than pixels with the margin in. The
 * eye stands at the azimuth (0 in front, at -y; 90 to the right, at +x) and elevation, in degrees.
 * Returns 0, or -1 if out of memory. */
int view_init(view* v, double azimuth, double elevation, vec size, int pixels, int margin,
              int with_normals);
void view_release(view* v);

/* Draws a disc about a point, of the given radius and unit normal, where it is the nearest yet. */
void view_draw_disc(view* v, vec point, double radius, vec normal);

static inline double view_column(const view* v, vec p) {
  return (dot(v->right, p) - v->left) * v->scale;
}
static inline double view_row(const view* v, vec p) {
  return (v->top - dot(v->up, p)) * v->scale;
}

#endif
