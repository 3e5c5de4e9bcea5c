/* SPDX-License-Identifier: Apache-2.0
 *
 * Each solid sample that the camera or the light sees becomes a small disc in a depth buffer. Its
 * normal is the gradient of the solid's share in a window of 9 x 9 x 9 samples, so nine layers are
 * held. */
#include "preview.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "png_image.h"
#include "shade.h"
#include "view.h"

enum { REACH = 4, WINDOW = 2 * REACH + 1, PICTURE = 1600, MARGIN = 120 };

/* The last layers of one solid, the newest last, each with a border of zeros. */
typedef struct stack {
  uint8_t* layers[WINDOW];
} stack;

struct preview {
  size_t columns; /* bytes of a layer's row */
  size_t stride;  /* bytes of a row here: one of zeros before it, two after it */
  size_t rows;    /* of a layer here: REACH of zeros on either side */
  vec step;       /* distance of samples */
  stack fine, coarse;
  uint64_t taken;
  int8_t ones[1 << WINDOW];   /* bits set in a row of the window */
  int8_t moment[1 << WINDOW]; /* sum of their columns, -REACH to REACH */
  view camera, light;         /* of the fine solid */
  view hull;                  /* of the coarse one, from the camera */
};

preview* preview_create(const msq_slicer_report* plan, double layer_height) {
  preview* p = calloc(1, sizeof *p);
  if (!p) return NULL;
  p->columns = (plan->width + 7u) / 8u;
  p->stride = p->columns + 3;
  p->rows = plan->height + 2u * REACH;
  p->step = make_vec(plan->pitch[0], plan->pitch[1], layer_height);
  for (int bits = 0; bits < 1 << WINDOW; ++bits) {
    for (int i = 0; i < WINDOW; ++i) {
      if (!(bits >> (WINDOW - 1 - i) & 1)) continue;
      p->ones[bits] = (int8_t)(p->ones[bits] + 1);
      p->moment[bits] = (int8_t)(p->moment[bits] + i - REACH);
    }
  }
  const vec size = make_vec(plan->width * plan->pitch[0], plan->height * plan->pitch[1],
                            (double)plan->layer_count * layer_height);
  const int pixels = PICTURE * SHADE_SUPER, margin = MARGIN * SHADE_SUPER;
  int failed = view_init(&p->camera, 32, 30, size, pixels, margin, 1);
  failed |= view_init(&p->hull, 32, 30, size, pixels, margin, 1);
  failed |= view_init(&p->light, -38, 52, size, PICTURE, 8, 0);
  for (int i = 0; i < WINDOW; ++i) {
    p->fine.layers[i] = calloc(p->rows, p->stride);
    p->coarse.layers[i] = calloc(p->rows, p->stride);
    failed |= !p->fine.layers[i] || !p->coarse.layers[i];
  }
  if (failed) {
    preview_free(p);
    return NULL;
  }
  return p;
}

void preview_free(preview* p) {
  if (!p) return;
  for (int i = 0; i < WINDOW; ++i) {
    free(p->fine.layers[i]);
    free(p->coarse.layers[i]);
  }
  view_release(&p->camera);
  view_release(&p->hull);
  view_release(&p->light);
  free(p);
}

/* A piece of the surface near a sample at bit x of a row, both counted with their borders. */
typedef struct surfel {
  vec normal;    /* from solid to void */
  double offset; /* of the surface from the sample along it, from the share of a smaller window */
} surfel;

static surfel surfel_at(const preview* p, const stack* s, size_t x, size_t row) {
  enum { SMALL = 5, LESS = (WINDOW - SMALL) / 2 };
  int mx = 0, my = 0, mz = 0, near = 0;
  for (int k = 0; k < WINDOW; ++k) {
    const uint8_t* at = s->layers[k] + (row - REACH) * p->stride + (x - REACH) / 8;
    const unsigned shift = 16 - WINDOW - (unsigned)(x - REACH) % 8;
    const int deep = k >= LESS && k < LESS + SMALL;
    for (int j = 0; j < WINDOW; ++j, at += p->stride) {
      const unsigned bits = (((unsigned)at[0] << 8 | at[1]) >> shift) & ((1u << WINDOW) - 1);
      mx += p->moment[bits];
      my += p->ones[bits] * (j - REACH);
      mz += p->ones[bits] * (k - REACH);
      if (deep && j >= LESS && j < LESS + SMALL) near += p->ones[bits >> LESS & ((1 << SMALL) - 1)];
    }
  }
  const vec n = make_vec(-mx / p->step.x, -my / p->step.y, -mz / p->step.z);
  const double length = sqrt(dot(n, n));
  surfel found = {{0, 0, 1}, 0};
  if (length == 0) return found;
  found.normal = scaled_sum(1 / length, n, 0, n);
  /* A half-space that ends t steps beyond the sample fills 1/2 + t / SMALL of the window. */
  const double steps = ((double)near / (SMALL * SMALL * SMALL) - 0.5) * SMALL;
  const vec along =
      make_vec(found.normal.x * p->step.x, found.normal.y * p->step.y, found.normal.z * p->step.z);
  found.offset = fmin(fmax(steps, -0.75), 1) * sqrt(dot(along, along));
  return found;
}

/* The samples of a byte whose three neighbours towards the eye are not all inside. */
static unsigned shown(const preview* p, const view* v, const stack* s, size_t at) {
  const uint8_t* layer = s->layers[REACH];
  const unsigned here = layer[at];
  const unsigned beside =
      v->toward.x > 0 ? here << 1 | layer[at + 1] >> 7 : here >> 1 | (unsigned)layer[at - 1] << 7;
  const unsigned along = v->toward.y > 0 ? layer[at + p->stride] : layer[at - p->stride];
  return here & ~(beside & along & s->layers[REACH + 1][at]) & 255u;
}

/* Draws the layer in the middle of the stack into one view or two. */
static void draw_layer(const preview* p, const stack* s, view* camera, view* light) {
  const double z = ((double)(p->taken - 1 - REACH) + 0.5) * p->step.z;
  const double radius = 0.5 * sqrt(dot(p->step, p->step));
  for (size_t row = REACH; row < p->rows - REACH; ++row) {
    for (size_t byte = 1; byte <= p->columns; ++byte) {
      const size_t at = row * p->stride + byte;
      if (!s->layers[REACH][at]) continue;
      const unsigned to_camera = shown(p, camera, s, at);
      const unsigned to_light = light ? shown(p, light, s, at) : 0;
      for (unsigned bit = 0; bit < 8; ++bit) {
        const unsigned mask = 128u >> bit;
        if (!((to_camera | to_light) & mask)) continue;
        const surfel found = surfel_at(p, s, byte * 8 + bit, row);
        const vec sample = make_vec(((double)(byte * 8 - 8 + bit) + 0.5) * p->step.x,
                                    ((double)(row - REACH) + 0.5) * p->step.y, z);
        const vec point = scaled_sum(1, sample, found.offset, found.normal);
        if (to_camera & mask) view_draw_disc(camera, point, radius, found.normal);
        if (to_light & mask) view_draw_disc(light, point, radius, found.normal);
      }
    }
  }
}

/* Moves a stack on by a layer of height rows; height 0: an empty one. */
static void push(const preview* p, stack* s, const uint8_t* data, uint64_t stride,
                 uint32_t height) {
  uint8_t* oldest = s->layers[0];
  memmove(s->layers, s->layers + 1, (WINDOW - 1) * sizeof s->layers[0]);
  s->layers[WINDOW - 1] = oldest;
  memset(oldest, 0, p->rows * p->stride);
  for (uint32_t y = 0; y < height; ++y) {
    memcpy(oldest + (y + REACH) * p->stride + 1, data + y * stride, p->columns);
  }
}

static void advance(preview* p, const uint8_t* fine, const uint8_t* coarse, uint64_t stride,
                    uint32_t height) {
  push(p, &p->fine, fine, stride, height);
  push(p, &p->coarse, coarse, stride, height);
  if (p->taken++ < REACH) return;
  draw_layer(p, &p->fine, &p->camera, &p->light);
  draw_layer(p, &p->coarse, &p->hull, NULL);
}

void preview_take(preview* p, const msq_layer* layer, const uint8_t* coarse) {
  advance(p, layer->data, coarse, layer->stride, layer->height);
}

int preview_save(preview* p, const char* path) {
  for (int i = 0; i < REACH; ++i) advance(p, NULL, NULL, 0, 0);
  uint8_t* pixels;
  int width, height;
  const double grain = sqrt(dot(p->step, p->step));
  if (shade(&p->camera, &p->hull, &p->light, grain, &pixels, &width, &height) != 0) return ENOMEM;
  const picture image = {PICTURE_RGB, (uint32_t)width,   (uint32_t)height,
                         pixels,      (size_t)width * 3, 0};
  const int code = png_image_save(path, &image);
  free(pixels);
  return code;
}
