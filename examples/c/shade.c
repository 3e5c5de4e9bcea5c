/* SPDX-License-Identifier: Apache-2.0
 *
 * Darkens what lies deep, by comparing the depth buffer with itself blurred. Source: Luft, Colditz
 * and Deussen, "Image enhancement by unsharp masking the depth buffer", 2006.
 */
#include "shade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BORDER = 44 }; /* pixels of paper about the picture */

typedef struct colour {
  double r, g, b; /* linear light, 0 to 1 */
} colour;

static const colour MATERIAL = {0.72, 0.29, 0.09};
static const colour CUT = {1.0, 0.60, 0.22};
static const colour SUN = {1.25, 1.18, 1.06};
static const colour SKY = {0.46, 0.52, 0.62};
static const colour BOUNCE = {0.24, 0.21, 0.19};
static const colour GLASS = {0.60, 0.70, 0.80};
static const colour EDGE = {0.12, 0.19, 0.29};
static const colour PAPER = {0.955, 0.96, 0.97};

/* Running sums of depth and of drawn pixels, for means over boxes: sum[y][x] is over rows < y and
 * columns < x. */
typedef struct depth_sums {
  int width, height; /* pixels of the picture, SHADE_SUPER times fewer than the view's */
  double* depth;
  double* count;
} depth_sums;

typedef struct scene {
  const view *camera, *hull, *light;
  double grain;
  depth_sums sums;
} scene;

static colour mix(colour a, colour b, double t) {
  const colour c = {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
  return c;
}

/* Share of the light that reaches a point: the mean of taps x taps look-ups in the light's depth
 * buffer, spread pixels apart. */
static double lit(const view* light, vec p, double bias, int taps, double spread) {
  const double column = view_column(light, p), row = view_row(light, p);
  const double depth = dot(light->toward, p) + bias;
  const double reach = 0.5 * taps * spread;
  if (column < -reach || column > light->width + reach || row < -reach ||
      row > light->height + reach) {
    return 1;
  }
  int seen = 0;
  for (int j = 0; j < taps; ++j) {
    const double y = row + (j - 0.5 * (taps - 1)) * spread;
    for (int i = 0; i < taps; ++i) {
      const double x = column + (i - 0.5 * (taps - 1)) * spread;
      if (!(x >= 0 && x < light->width && y >= 0 && y < light->height)) {
        ++seen;
      } else {
        seen += light->depth[(size_t)y * (size_t)light->width + (size_t)x] <= depth;
      }
    }
  }
  return (double)seen / (taps * taps);
}

static int sum_depths(const view* v, depth_sums* s) {
  s->width = v->width / SHADE_SUPER;
  s->height = v->height / SHADE_SUPER;
  const size_t stride = (size_t)s->width + 1, count = stride * ((size_t)s->height + 1);
  s->depth = calloc(count, sizeof *s->depth);
  s->count = calloc(count, sizeof *s->count);
  if (!s->depth || !s->count) return -1;
  for (int y = 0; y < s->height; ++y) {
    double depth = 0, drawn = 0;
    for (int x = 0; x < s->width; ++x) {
      const float d =
          v->depth[(size_t)(y * SHADE_SUPER) * (size_t)v->width + (size_t)(x * SHADE_SUPER)];
      if (d != (float)VIEW_EMPTY) {
        depth += d;
        drawn += 1;
      }
      const size_t at = (size_t)(y + 1) * stride + (size_t)x + 1;
      s->depth[at] = s->depth[at - stride] + depth;
      s->count[at] = s->count[at - stride] + drawn;
    }
  }
  return 0;
}

/* Mean depth about a pixel of the picture; fallback where nothing is drawn. */
static double mean_depth(const depth_sums* s, int x, int y, int reach, double fallback) {
  const size_t stride = (size_t)s->width + 1;
  const size_t x0 = (size_t)(x > reach ? x - reach : 0), y0 = (size_t)(y > reach ? y - reach : 0);
  const size_t x1 = (size_t)(x + reach < s->width ? x + reach + 1 : s->width);
  const size_t y1 = (size_t)(y + reach < s->height ? y + reach + 1 : s->height);
  const size_t a = y0 * stride + x0, b = y0 * stride + x1;
  const size_t c = y1 * stride + x0, d = y1 * stride + x1;
  const double count = s->count[d] - s->count[c] - s->count[b] + s->count[a];
  return count > 0 ? (s->depth[d] - s->depth[c] - s->depth[b] + s->depth[a]) / count : fallback;
}

/* 0 in the open to 1 deep down, over a narrow and a wide neighbourhood. */
static double buried(const depth_sums* s, const view* camera, int x, int y, double depth) {
  double dark = 0;
  for (int reach = 7; reach <= 35; reach *= 5) {
    const double range = 1.6 * reach * SHADE_SUPER / camera->scale;
    const double below = (mean_depth(s, x, y, reach, depth) - depth) / range;
    dark += 0.5 * fmin(fmax(below, 0), 1);
  }
  return dark;
}

static vec to_vec(const view* v, const int8_t n[3]) {
  return scaled_sum(1, scaled_sum(n[0] / 127.0, v->right, n[1] / 127.0, v->up), n[2] / 127.0,
                    v->toward);
}

/* The point of the model at a place of the camera's picture. */
static vec point_at(const view* v, int x, int y, double depth) {
  const vec flat =
      scaled_sum(v->left + (x + 0.5) / v->scale, v->right, v->top - (y + 0.5) / v->scale, v->up);
  return scaled_sum(1, flat, depth, v->toward);
}

static double highlight(const view* camera, const view* light, vec normal, double sharpness) {
  const vec half = scaled_sum(1, light->toward, 1, camera->toward);
  return pow(fmax(dot(normal, half), 0) / sqrt(dot(half, half)), sharpness);
}

static colour shade_part(const scene* s, int x, int y) {
  const view *camera = s->camera, *light = s->light;
  const size_t at = (size_t)y * (size_t)camera->width + (size_t)x;
  const double depth = camera->depth[at];
  const vec normal = to_vec(camera, camera->normal[at]);
  const vec p = scaled_sum(1, point_at(camera, x, y, depth), 2 * s->grain, normal);

  const double sun = fmax(dot(normal, light->toward), 0) * lit(light, p, s->grain, 5, 1.1);
  double open = 1 - 0.8 * buried(&s->sums, camera, x / SHADE_SUPER, y / SHADE_SUPER, depth);
  /* Less light reaches what lies deep in the part. */
  const double under = (s->hull->depth[at] - depth) * camera->scale / camera->width;
  open *= 0.25 + 0.75 * exp(-fmax(under, 0) / 0.07);
  /* Struts show a fresh face where the hull cuts them. */
  const double gap = (s->hull->depth[at] - depth) / s->grain;
  const colour skin = mix(CUT, MATERIAL, fmin(fmax(0.7 * gap - 0.4, 0), 1));
  const colour ambient = mix(BOUNCE, SKY, 0.5 + 0.5 * normal.z);
  const double shine = sun > 0 ? 0.10 * sun * highlight(camera, light, normal, 40) : 0;
  const double direct = 0.80 * sun * (0.25 + 0.75 * open);
  const colour c = {skin.r * (direct * SUN.r + open * ambient.r) + shine,
                    skin.g * (direct * SUN.g + open * ambient.g) + shine,
                    skin.b * (direct * SUN.b + open * ambient.b) + shine};
  return c;
}

/* What lies on the line of sight at z = 0. */
static colour shade_ground(const scene* s, int x, int y) {
  const vec start = point_at(s->camera, x, y, 0);
  const vec p = scaled_sum(1, start, -start.z / s->camera->toward.z, s->camera->toward);
  const colour shadow = {PAPER.r * 0.56, PAPER.g * 0.58, PAPER.b * 0.62};
  return mix(shadow, PAPER, lit(s->light, p, 0, 11, 2.3));
}

/* 0 to 1: how much of the hull's lines runs through a pixel: steps of depth, and creases. */
static double outline(const view* hull, double grain, int x, int y) {
  static const int around[8][2] = {{3, 0}, {-3, 0}, {0, 3},  {0, -3},
                                   {2, 2}, {-2, 2}, {2, -2}, {-2, -2}};
  const size_t at = (size_t)y * (size_t)hull->width + (size_t)x;
  const int8_t* n = hull->normal[at];
  int steps = 0;
  double crease = 0;
  for (int i = 0; i < 8; ++i) {
    const int nx = x + around[i][0], ny = y + around[i][1];
    if (nx < 0 || nx >= hull->width || ny < 0 || ny >= hull->height) continue;
    const size_t there = (size_t)ny * (size_t)hull->width + (size_t)nx;
    const int8_t* m = hull->normal[there];
    if (hull->depth[at] - hull->depth[there] > 8 * grain) {
      ++steps;
    } else if (hull->depth[there] - hull->depth[at] < 8 * grain) {
      crease = fmax(crease, 1 - (n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) / (127.0 * 127.0));
    }
  }
  return fmin(fmax(steps / 3.0, fmin(4 * crease, 0.5)), 1);
}

/* Lays the hull over a colour: clear where it faces the camera, milky at its edges. */
static colour glaze(const scene* s, int x, int y, colour below) {
  const size_t at = (size_t)y * (size_t)s->hull->width + (size_t)x;
  if (s->hull->depth[at] == (float)VIEW_EMPTY) return below;
  /* Where the solid itself is the hull, there is no glass before it. */
  const double gap = s->hull->depth[at] - s->camera->depth[at];
  const double cover = fmin(fmax(gap / s->grain - 1, 0), 1);
  const vec normal = to_vec(s->hull, s->hull->normal[at]);
  const double edge = 1 - fmax(dot(normal, s->hull->toward), 0);
  colour glazed = mix(below, GLASS, cover * (0.05 + 0.55 * edge * edge * edge));
  glazed = mix(glazed, EDGE, 0.8 * cover * outline(s->hull, s->grain, x, y));
  if (cover == 0) return glazed;
  const colour white = {1, 1, 1};
  return mix(glazed, white, 0.25 * cover * highlight(s->camera, s->light, normal, 60));
}

static colour shade_pixel(const scene* s, int x, int y) {
  colour total = {0, 0, 0}, ground = PAPER;
  int ground_known = 0;
  for (int i = 0; i < SHADE_SUPER * SHADE_SUPER; ++i) {
    const int vx = x * SHADE_SUPER + i % SHADE_SUPER, vy = y * SHADE_SUPER + i / SHADE_SUPER;
    const float depth = s->camera->depth[(size_t)vy * (size_t)s->camera->width + (size_t)vx];
    const int empty = depth == (float)VIEW_EMPTY;
    if (empty && !ground_known) {
      ground = shade_ground(s, vx, vy); /* smooth: once a pixel will do */
      ground_known = 1;
    }
    const colour c = glaze(s, vx, vy, empty ? ground : shade_part(s, vx, vy));
    total.r += c.r / (SHADE_SUPER * SHADE_SUPER);
    total.g += c.g / (SHADE_SUPER * SHADE_SUPER);
    total.b += c.b / (SHADE_SUPER * SHADE_SUPER);
  }
  return total;
}

static uint8_t encode(double linear) {
  const double v = fmin(fmax(linear, 0), 1);
  const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
  return (uint8_t)(255 * srgb + 0.5);
}

/* Cuts away the paper that is further than BORDER from anything. */
static void crop(uint8_t* pixels, int* width, int* height) {
  const uint8_t paper = encode(PAPER.r);
  int x0 = *width, x1 = -1, y0 = *height, y1 = -1;
  for (int y = 0; y < *height; ++y) {
    for (int x = 0; x < *width; ++x) {
      if (pixels[3 * ((size_t)y * (size_t)*width + (size_t)x)] == paper) continue;
      x0 = x < x0 ? x : x0;
      x1 = x > x1 ? x : x1;
      y0 = y < y0 ? y : y0;
      y1 = y > y1 ? y : y1;
    }
  }
  if (x1 < 0) return;
  x0 = x0 > BORDER ? x0 - BORDER : 0;
  y0 = y0 > BORDER ? y0 - BORDER : 0;
  x1 = x1 + BORDER < *width ? x1 + BORDER : *width - 1;
  y1 = y1 + BORDER < *height ? y1 + BORDER : *height - 1;
  const size_t row = 3 * (size_t)(x1 - x0 + 1);
  for (int y = y0; y <= y1; ++y) {
    memmove(pixels + (size_t)(y - y0) * row, pixels + 3 * ((size_t)y * (size_t)*width + (size_t)x0),
            row);
  }
  *width = x1 - x0 + 1;
  *height = y1 - y0 + 1;
}

int shade(const view* camera, const view* hull, const view* light, double grain, uint8_t** pixels,
          int* width, int* height) {
  scene s = {camera, hull, light, grain, {0, 0, NULL, NULL}};
  uint8_t* out = NULL;
  if (sum_depths(camera, &s.sums) == 0) {
    out = malloc(3 * (size_t)s.sums.width * (size_t)s.sums.height);
  }
  *width = s.sums.width;
  *height = s.sums.height;
  for (int y = 0; out && y < *height; ++y) {
    for (int x = 0; x < *width; ++x) {
      const colour c = shade_pixel(&s, x, y);
      uint8_t* at = out + 3 * ((size_t)y * (size_t)*width + (size_t)x);
      at[0] = encode(c.r);
      at[1] = encode(c.g);
      at[2] = encode(c.b);
    }
  }
  free(s.sums.depth);
  free(s.sums.count);
  if (out) crop(out, width, height);
  *pixels = out;
  return out ? 0 : -1;
}
