/* SPDX-License-Identifier: Apache-2.0
 *
 * A thread that renders. While the view moves, pictures are small enough to keep it smooth. When
 * the view stands still, the whole picture becomes finer and finer, until another is requested. */
#ifndef MSQ_EXAMPLE_PAINTER_H
#define MSQ_EXAMPLE_PAINTER_H

#include <SDL.h>
#include <msq.h>

typedef struct painter painter;

typedef struct paint_order {
  const msq_model* model; /* the painter keeps it alive meanwhile */
  msq_camera camera;
  uint32_t width, height; /* of the window, pixels */
  double length_scale;
  int has_shadows; /* in the finest picture, and ambient occlusion */
} paint_order;

typedef struct paint_report {
  uint64_t order;         /* which order it is a picture of: painter_ask counts them from 1 */
  uint32_t width, height; /* of the picture */
  double coarseness;      /* of the window's pixels, along a side of one of the picture's */
  double seconds;         /* that it took */
  uint32_t step, samples; /* of msq_render_pass; a moving view's has 1, 1 */
  int is_moving;
  int is_last; /* no better one of this order will come */
} paint_report;

/* A painter that pushes an SDL event of this type for each picture, and for each failure. NULL if
 * there is no memory, or no thread. */
painter* painter_create(Uint32 event);
void painter_free(painter* p);

/* Asks for a picture in place of those that were asked for before; returns at once. Returns the
 * order's number. */
uint64_t painter_ask(painter* p, const paint_order* order);

/* Draws the newest picture into the texture, which becomes one of its size. Returns 1 and fills in
 * the report, 0 where there is none that is newer than the last taken, -1 where msq has failed,
 * with *problem set. */
int painter_take(painter* p, SDL_Renderer* renderer, SDL_Texture** texture, paint_report* report,
                 const char** problem);

#endif
