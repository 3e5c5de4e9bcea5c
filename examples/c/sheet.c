/* SPDX-License-Identifier: Apache-2.0 */
#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "png_image.h"

enum { COLUMNS = 4, ROWS = 3, TILES = COLUMNS * ROWS, TILE_SIDE = 340, GAP = 24, LABEL = 34 };
enum { PAPER = 255, COARSE = 218, INSIDE = 32, INK = 90 };

struct sheet {
  uint64_t layer_count;
  uint32_t tile_width, tile_height;
  uint32_t width, height;
  uint8_t* pixels;
};

sheet* sheet_create(const msq_slicer_report* plan) {
  sheet* s = calloc(1, sizeof *s);
  if (!s) return NULL;
  /* The longer side of a layer, in model units, fills the tile. */
  const double x = plan->width * plan->pitch[0], y = plan->height * plan->pitch[1];
  const double scale = TILE_SIDE / (x > y ? x : y);
  s->layer_count = plan->layer_count;
  s->tile_width = (uint32_t)(x * scale + 0.5) > 0 ? (uint32_t)(x * scale + 0.5) : 1;
  s->tile_height = (uint32_t)(y * scale + 0.5) > 0 ? (uint32_t)(y * scale + 0.5) : 1;
  s->width = GAP + COLUMNS * (s->tile_width + GAP);
  s->height = GAP + ROWS * (s->tile_height + LABEL + GAP) - GAP / 2;
  s->pixels = malloc((size_t)s->width * s->height);
  if (!s->pixels) {
    free(s);
    return NULL;
  }
  memset(s->pixels, PAPER, (size_t)s->width * s->height);
  return s;
}

/* How much of pixel i lies between from and to. */
static double overlap(uint32_t i, double from, double to) {
  const double low = i > from ? i : from, high = i + 1.0 < to ? i + 1.0 : to;
  return high > low ? high - low : 0;
}

/* Share of the layer's rectangle, in pixels of its own, that is set in bits. */
static double share_of(const msq_layer* layer, const uint8_t* bits, double x0, double x1, double y0,
                       double y1) {
  double inside = 0;
  for (uint32_t y = (uint32_t)y0; y < layer->height && y < y1; ++y) {
    const uint8_t* row = bits + y * layer->stride;
    const double weight = overlap(y, y0, y1);
    for (uint32_t x = (uint32_t)x0; x < layer->width && x < x1; ++x) {
      if (row[x / 8] >> (7 - x % 8) & 1) inside += weight * overlap(x, x0, x1);
    }
  }
  return inside / ((x1 - x0) * (y1 - y0));
}

static void draw_layer(sheet* s, uint32_t left, uint32_t top, const msq_layer* layer,
                       const uint8_t* coarse) {
  const double sx = (double)layer->width / s->tile_width;
  const double sy = (double)layer->height / s->tile_height;
  for (uint32_t ty = 0; ty < s->tile_height; ++ty) {
    const uint32_t up = s->tile_height - 1 - ty; /* layers begin at the smallest y */
    for (uint32_t tx = 0; tx < s->tile_width; ++tx) {
      const double x0 = tx * sx, x1 = (tx + 1) * sx, y0 = up * sy, y1 = (up + 1) * sy;
      const double within = share_of(layer, coarse, x0, x1, y0, y1);
      const double inside = share_of(layer, layer->data, x0, x1, y0, y1);
      s->pixels[(size_t)(top + ty) * s->width + left + tx] =
          (uint8_t)(PAPER + within * (COARSE - PAPER) + inside * (INSIDE - COARSE) + 0.5);
    }
  }
}

/* A font of 5 x 7 pixels with just the letters of "z = -0123456789. mm"; a byte a row. */
static const struct {
  char letter;
  uint8_t rows[7];
} font[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 2, 4, 8, 31}},     {'3', {31, 2, 4, 2, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'z', {0, 0, 31, 2, 4, 8, 31}},      {'=', {0, 0, 31, 0, 31, 0, 0}},
    {'m', {0, 0, 26, 21, 21, 17, 17}},
};

static void draw_text(sheet* s, uint32_t left, uint32_t top, const char* text) {
  enum { SCALE = 2 };
  for (; *text; ++text, left += 6 * SCALE) {
    for (size_t g = 0; g < sizeof font / sizeof font[0]; ++g) {
      if (font[g].letter != *text) continue;
      for (uint32_t y = 0; y < 7 * SCALE; ++y) {
        for (uint32_t x = 0; x < 5 * SCALE; ++x) {
          const int on = font[g].rows[y / SCALE] >> (4 - x / SCALE) & 1;
          if (on && left + x < s->width) s->pixels[(size_t)(top + y) * s->width + left + x] = INK;
        }
      }
    }
  }
}

void sheet_take(sheet* s, const msq_layer* layer, const uint8_t* coarse) {
  for (uint64_t tile = 0; tile < TILES; ++tile) {
    /* Tile t shows the layer in the middle of the t-th of TILES equal parts of the stack. */
    if (layer->index != (2 * tile + 1) * s->layer_count / (2 * TILES)) continue;
    const uint32_t left = GAP + (uint32_t)(tile % COLUMNS) * (s->tile_width + GAP);
    const uint32_t top = GAP + (uint32_t)(tile / COLUMNS) * (s->tile_height + LABEL + GAP);
    draw_layer(s, left, top, layer, coarse);
    char label[64];
    snprintf(label, sizeof label, "z = %.2f mm", layer->z);
    draw_text(s, left, top + s->tile_height + 10, label);
  }
}

int sheet_save(const sheet* s, const char* path) {
  const picture image = {PICTURE_GREY, s->width, s->height, s->pixels, s->width, 0};
  return png_image_save(path, &image);
}

void sheet_free(sheet* s) {
  if (!s) return;
  free(s->pixels);
  free(s);
}
