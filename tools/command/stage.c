/* SPDX-License-Identifier: Apache-2.0 */
#include "stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "orbit.h"

enum { LIGHTS = 12, BLUR = 2, HULL = 2 }; /* shadow rays a pixel; pixels; hull's sub-samples */
#define HAZE 0.3 /* share of the background at the farthest point of the part */

#define TRY(call)                          \
  do {                                     \
    const msq_status status_ = (call);     \
    if (status_ != MSQ_OK) return status_; \
  } while (0)

/* Any number from 0 to 1 that looks as if at random. */
static double noise(uint32_t n) {
  n = (n ^ 61u ^ n >> 16) * 9u;
  n = (n ^ n >> 4) * 0x27d4eb2du;
  return (n ^ n >> 15) * (1.0 / 4294967295.0);
}

/* share[i]: of the light that pixel i of the row loses where it shows the ground. */
static msq_status cast_row(const stage* s, const frame_of_view* f, uint32_t row,
                           const uint8_t* rgba, double* rays, msq_ray_hit* hits, float* share) {
  double light[3];
  for (int a = 0; a < 3; ++a)
    light[a] = s->light[0] * f->right[a] + s->light[1] * f->up[a] - s->light[2] * f->forward[a];
  const double length = sqrt(dot3(light, light));
  uint64_t count = 0;
  for (uint32_t i = 0; i < s->width; ++i) {
    const double middle[2] = {i + 0.5, row + 0.5};
    double origin[3], direction[3];
    share[i] = 0;
    if (rgba[4 * i + 3] == 255) continue;
    TRY(msq_camera_ray(s->camera, s->width, s->height, middle, origin, direction));
    const double t = (s->ground - origin[2]) / direction[2];
    if (!(t > 0) || !(t < 1e9)) continue;
    share[i] = 1;
    for (int k = 0; k < LIGHTS; ++k, ++count) {
      double* ray = rays + 6 * count;
      const uint32_t seed = (row * s->width + i) * 2u * LIGHTS + 2u * (uint32_t)k;
      const double radius = 0.09 * sqrt((k + noise(seed)) / LIGHTS);
      const double angle = 6.283185307179586 * noise(seed + 1);
      for (int a = 0; a < 3; ++a) ray[a] = origin[a] + t * direction[a];
      for (int a = 0; a < 3; ++a) ray[3 + a] = light[a] / length;
      ray[3] += radius * cos(angle);
      ray[4] += radius * sin(angle);
    }
  }
  if (count == 0) return MSQ_OK;
  msq_rays_def def;
  TRY(msq_rays_def_init(&def, sizeof def));
  def.count = count;
  def.origins = rays;
  def.directions = rays + 3;
  def.origin_stride = def.direction_stride = 6 * sizeof *rays;
  TRY(msq_ray_cast(s->model, &def, NULL, hits, count, NULL));
  const msq_ray_hit* hit = hits;
  for (uint32_t i = 0; i < s->width; ++i) {
    if (share[i] == 0) continue;
    int dark = 0;
    for (int k = 0; k < LIGHTS; ++k) dark += (hit++)->scale >= 0;
    share[i] = (float)dark / LIGHTS;
  }
  return MSQ_OK;
}

static msq_status cast_ground(const stage* s, const frame_of_view* f, const uint8_t* rgba,
                              float* share) {
  double* rays = malloc(6u * LIGHTS * s->width * sizeof *rays);
  msq_ray_hit* hits = malloc((size_t)LIGHTS * s->width * sizeof *hits);
  msq_status status = rays && hits ? MSQ_OK : MSQ_E_MEMORY;
  for (uint32_t row = 0; row < s->height && status == MSQ_OK; ++row) {
    const size_t at = (size_t)row * s->width;
    status = cast_row(s, f, row, rgba + 4 * at, rays, hits, share + at);
  }
  free(rays);
  free(hits);
  return status;
}

/* Mean of the shadows about a pixel, among those that show the ground. */
static double soft_shadow(const stage* s, const uint8_t* rgba, const float* share, int x, int y) {
  double sum = 0, count = 0;
  for (int v = y - BLUR; v <= y + BLUR; ++v)
    for (int u = x - BLUR; u <= x + BLUR; ++u) {
      if (u < 0 || v < 0 || u >= (int)s->width || v >= (int)s->height) continue;
      const size_t at = (size_t)v * s->width + (size_t)u;
      if (rgba[4 * at + 3] == 255) continue;
      sum += share[at];
      count += 1;
    }
  return count > 0 ? sum / count : 0;
}

/* How much of the glass one sees at a pixel: most where it is seen edge-on. */
static double rim(const stage* s, const frame_of_view* f, const float* normals, uint32_t x,
                  uint32_t y) {
  double sum = 0;
  for (uint32_t v = 0; v < HULL; ++v)
    for (uint32_t u = 0; u < HULL; ++u) {
      const float* n = normals + 3 * ((size_t)(HULL * y + v) * HULL * s->width + HULL * x + u);
      const double normal[3] = {n[0], n[1], n[2]};
      if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
      const double edge = 1 - fabs(dot3(normal, f->forward));
      sum += 0.03 + 0.5 * edge * edge * edge * edge;
    }
  return sum / (HULL * HULL);
}

/* Least and greatest depth of the picture. */
static void depth_range(const stage* s, float range[2]) {
  const size_t count = (size_t)s->width * s->height;
  range[0] = INFINITY;
  range[1] = -INFINITY;
  for (size_t i = 0; i < count; ++i) {
    if (!isfinite(s->depth[i])) continue;
    range[0] = fminf(range[0], s->depth[i]);
    range[1] = fmaxf(range[1], s->depth[i]);
  }
}

/* How much haze is before a pixel: depth is that of its centre, or of the nearest of its neighbours
 * where the ray through the centre misses the part. */
static double haze(const stage* s, const float range[2], int x, int y) {
  float depth = s->depth[(size_t)y * s->width + (size_t)x];
  for (int v = y - 1; v <= y + 1 && !isfinite(depth); ++v)
    for (int u = x - 1; u <= x + 1; ++u) {
      if (u < 0 || v < 0 || u >= (int)s->width || v >= (int)s->height) continue;
      depth = fminf(depth, s->depth[(size_t)v * s->width + (size_t)u]);
    }
  if (!isfinite(depth) || !(range[1] > range[0])) return 0;
  return HAZE * (depth - range[0]) / (range[1] - range[0]);
}

static msq_status render_hull(const stage* s, float* normals) {
  msq_render_def def;
  msq_query_def query;
  msq_frame frame;
  TRY(msq_render_def_init(&def, sizeof def));
  TRY(msq_query_def_init(&query, sizeof query));
  TRY(msq_frame_init(&frame, sizeof frame));
  def.width = HULL * s->width;
  def.height = HULL * s->height;
  query.length_scale = INFINITY; /* the coarse part alone */
  frame.normal = normals;
  return msq_render(s->model, s->camera, &def, &query, &frame, NULL, NULL, NULL);
}

static void mix(double rgb[3], double r, double g, double b, double share) {
  rgb[0] += share * (r - rgb[0]);
  rgb[1] += share * (g - rgb[1]);
  rgb[2] += share * (b - rgb[2]);
}

msq_status stage_compose(const stage* s, const uint8_t* rgba, uint8_t* rgb) {
  const size_t count = (size_t)s->width * s->height;
  const frame_of_view f = frame_of(s->camera);
  float* share = calloc(count, sizeof *share);
  float* normals = s->glass ? malloc(3 * HULL * HULL * count * sizeof *normals) : NULL;
  msq_status status = share && (normals || !s->glass) ? MSQ_OK : MSQ_E_MEMORY;
  if (status == MSQ_OK && s->has_ground) status = cast_ground(s, &f, rgba, share);
  if (status == MSQ_OK && s->glass) status = render_hull(s, normals);
  float range[2];
  depth_range(s, range);
  for (uint32_t y = 0; status == MSQ_OK && y < s->height; ++y)
    for (uint32_t x = 0; x < s->width; ++x) {
      const size_t at = (size_t)y * s->width + x;
      const uint8_t* in = rgba + 4 * at;
      const double down = (double)y / s->height;
      double out[3] = {252 - 12 * down, 253 - 10 * down, 254 - 7 * down};
      if (s->has_ground) mix(out, 96, 106, 122, 0.75 * soft_shadow(s, rgba, share, (int)x, (int)y));
      mix(out, in[0], in[1], in[2], in[3] / 255.0 * (1 - haze(s, range, (int)x, (int)y)));
      if (s->glass) mix(out, 120, 138, 160, rim(s, &f, normals, x, y));
      for (int a = 0; a < 3; ++a) rgb[3 * at + (size_t)a] = (uint8_t)(out[a] + 0.5);
    }
  free(share);
  free(normals);
  return status;
}
