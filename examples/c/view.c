/* SPDX-License-Identifier: Apache-2.0 */
#include "view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int view_init(view* v, double azimuth, double elevation, vec size, int pixels, int margin,
              int with_normals) {
  const double degree = 0.017453292519943295;
  const double ca = cos(azimuth * degree), sa = sin(azimuth * degree);
  const double ce = cos(elevation * degree), se = sin(elevation * degree);
  memset(v, 0, sizeof *v);
  v->right = make_vec(ca, sa, 0);
  v->up = make_vec(-se * sa, se * ca, ce);
  v->toward = make_vec(ce * sa, -ce * ca, se);

  double x0 = DBL_MAX, x1 = -DBL_MAX, y0 = DBL_MAX, y1 = -DBL_MAX;
  for (int corner = 0; corner < 8; ++corner) {
    const vec p =
        make_vec(corner & 1 ? size.x : 0, corner & 2 ? size.y : 0, corner & 4 ? size.z : 0);
    x0 = fmin(x0, dot(v->right, p));
    x1 = fmax(x1, dot(v->right, p));
    y0 = fmin(y0, dot(v->up, p));
    y1 = fmax(y1, dot(v->up, p));
  }
  v->scale = (pixels - 2 * margin) / fmax(x1 - x0, y1 - y0);
  v->left = x0 - margin / v->scale;
  v->top = y1 + margin / v->scale;
  v->width = (int)ceil((x1 - x0) * v->scale) + 2 * margin;
  v->height = (int)ceil((y1 - y0) * v->scale) + 2 * margin;

  const size_t count = (size_t)v->width * (size_t)v->height;
  v->depth = malloc(count * sizeof *v->depth);
  if (with_normals) v->normal = calloc(count, sizeof *v->normal);
  if (!v->depth || (with_normals && !v->normal)) return -1;
  for (size_t i = 0; i < count; ++i) v->depth[i] = VIEW_EMPTY;
  return 0;
}

void view_release(view* v) {
  free(v->depth);
  free(v->normal);
}

void view_draw_disc(view* v, vec point, double radius, vec normal) {
  const vec n = make_vec(dot(v->right, normal), dot(v->up, normal), dot(v->toward, normal));
  /* The disc's plane gives its depth; where it is seen edge-on, its slope is held back. */
  const double facing = n.z > 0.3 ? n.z : 0.3;
  const double slope_x = -n.x / facing / v->scale, slope_y = n.y / facing / v->scale;
  const int8_t packed[3] = {(int8_t)(127 * n.x), (int8_t)(127 * n.y), (int8_t)(127 * n.z)};

  const double column = view_column(v, point), row = view_row(v, point);
  const double depth = dot(v->toward, point);
  const double reach = fmax(radius * v->scale, 0.75);
  const int x0 = (int)fmax(ceil(column - reach - 0.5), 0);
  const int x1 = (int)fmin(floor(column + reach - 0.5), v->width - 1);
  const int y0 = (int)fmax(ceil(row - reach - 0.5), 0);
  const int y1 = (int)fmin(floor(row + reach - 0.5), v->height - 1);
  for (int y = y0; y <= y1; ++y) {
    const double dy = y + 0.5 - row;
    for (int x = x0; x <= x1; ++x) {
      const double dx = x + 0.5 - column;
      if (dx * dx + dy * dy > reach * reach) continue;
      const size_t at = (size_t)y * (size_t)v->width + (size_t)x;
      const float here = (float)(depth + slope_x * dx + slope_y * dy);
      if (here <= v->depth[at]) continue;
      v->depth[at] = here;
      if (v->normal) memcpy(v->normal[at], packed, sizeof packed);
    }
  }
}
