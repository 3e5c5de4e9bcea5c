/* SPDX-License-Identifier: Apache-2.0 */
#include "painter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pictures of a moving view are to take GOAL seconds; those that take LIMIT are given up for a
 * newer order. A view stands still after PAUSE without one. */
static const double GOAL = 0.035, LIMIT = 0.25;
enum { PAUSE_MS = 60, FIRST_STEP = 8, SAMPLES = 2, MOST_COARSE = 8 };

/* The pictures of an order, one after the other: a small one; the whole one; with shadows too. */
enum { MOVING, WHOLE, FINEST, QUALITIES };

struct painter {
  SDL_Thread* thread;
  SDL_mutex* mutex; /* of all below but what is said to be the thread's */
  SDL_cond* changed;
  Uint32 event;
  int is_ending;
  paint_order order; /* the newest */
  uint64_t order_count;
  msq_job* job; /* in work; NULL: none */
  int quality;
  Uint64 began;
  uint8_t* shown; /* the newest picture */
  size_t shown_room;
  paint_report report;
  int is_new;
  char problem[512];
  /* The thread's: */
  uint8_t* pixels;
  size_t room;
  double coarseness; /* of the next picture of a moving view */
  double seen;       /* of the last one, in pixels along a side; infinity: it was given up */
  paint_report work;
};

static double seconds_since(Uint64 start) {
  return (double)(SDL_GetPerformanceCounter() - start) / (double)SDL_GetPerformanceFrequency();
}

static void push_event(const painter* p) {
  SDL_Event event;
  SDL_zero(event);
  event.type = p->event;
  SDL_PushEvent(&event);
}

static void report_problem(painter* p, const char* problem) {
  SDL_LockMutex(p->mutex);
  snprintf(p->problem, sizeof p->problem, "%s", problem);
  SDL_UnlockMutex(p->mutex);
  push_event(p);
}

/* Called by msq_render on our thread: hands a copy of the picture over. */
static int32_t take_pass(void* user, const msq_render_pass* pass) {
  painter* p = user;
  const size_t bytes = 4 * (size_t)p->work.width * p->work.height;
  if (pass->step > p->seen) return 0; /* coarser than what is there */
  p->work.step = pass->step;
  p->work.samples = pass->samples;
  p->work.is_last = pass->is_last && p->quality == FINEST;
  p->work.seconds = seconds_since(p->began);
  SDL_LockMutex(p->mutex);
  if (p->shown_room < bytes) {
    free(p->shown);
    p->shown = malloc(bytes);
    p->shown_room = p->shown ? bytes : 0;
  }
  const int good = p->shown != NULL;
  if (good) {
    memcpy(p->shown, p->pixels, bytes);
    p->report = p->work;
    p->is_new = 1;
  }
  SDL_UnlockMutex(p->mutex);
  push_event(p);
  return good ? 0 : -1;
}

static msq_status render(painter* p, const paint_order* o, msq_job* job) {
  msq_render_def def;
  msq_query_def query;
  msq_frame frame;
  msq_status status = msq_render_def_init(&def, sizeof def);
  if (status == MSQ_OK) status = msq_query_def_init(&query, sizeof query);
  if (status == MSQ_OK) status = msq_frame_init(&frame, sizeof frame);
  if (status != MSQ_OK) return status;
  static const double colours[] = {0.80, 0.62, 0.40, 0.85, 0.30, 0.05,
                                   0.10, 0.38, 0.55, 0.45, 0.55, 0.12};
  static const double background[4] = {0.80, 0.83, 0.87, 1}, light[3] = {-0.5, 0.7, 0.6};
  def.width = p->work.width;
  def.height = p->work.height;
  def.colour_by = MSQ_COLOUR_SCALE;
  def.colours = colours;
  def.colour_count = 4;
  memcpy(def.background, background, sizeof background);
  memcpy(def.light, light, sizeof light);
  if (p->quality == WHOLE) def.first_step = FIRST_STEP;
  if (p->quality == FINEST) {
    def.samples = SAMPLES;
    def.shadows = o->has_shadows;
    def.occlusion_rays = o->has_shadows ? 4 : 0;
  }
  query.length_scale = o->length_scale;
  frame.rgba = p->pixels;
  return msq_render(o->model, &o->camera, &def, &query, &frame, take_pass, p, job);
}

/* Renders one picture, pass by pass. */
static void paint(painter* p, const paint_order* o, uint64_t number, int quality) {
  const int is_moving = quality == MOVING;
  const double coarse = is_moving ? p->coarseness : 1;
  const paint_report work = {.order = number,
                             .width = (uint32_t)fmax(1, round(o->width / coarse)),
                             .height = (uint32_t)fmax(1, round(o->height / coarse)),
                             .coarseness = coarse,
                             .is_moving = is_moving};
  const size_t bytes = 4 * (size_t)work.width * work.height;
  p->work = work;
  if (p->room < bytes) {
    free(p->pixels);
    p->pixels = malloc(bytes);
    p->room = p->pixels ? bytes : 0;
  }
  msq_job* job = NULL;
  if (!p->pixels || msq_job_create(&job) != MSQ_OK) {
    report_problem(p, "out of memory");
    return;
  }
  SDL_LockMutex(p->mutex);
  const int is_wanted = is_moving || p->order_count == number;
  p->job = job;
  p->quality = quality;
  p->began = SDL_GetPerformanceCounter();
  SDL_UnlockMutex(p->mutex);
  if (is_moving) p->seen = INFINITY;
  const msq_status status = is_wanted ? render(p, o, job) : MSQ_E_CANCELLED;
  if (status != MSQ_OK && status != MSQ_E_CANCELLED) report_problem(p, msq_error_message());
  SDL_LockMutex(p->mutex);
  p->job = NULL;
  SDL_UnlockMutex(p->mutex);
  msq_job_release(job);
  if (is_moving && status == MSQ_OK) p->seen = coarse;
  if (is_moving) { /* the time goes as the number of pixels, about */
    const double wanted = coarse * sqrt(seconds_since(p->began) / GOAL);
    p->coarseness = fmin(fmax(sqrt(coarse * fmin(wanted, 4 * coarse)), 1), MOST_COARSE);
  }
}

static int SDLCALL run(void* user) {
  painter* p = user;
  uint64_t number = 0;     /* of the order in work, */
  int quality = QUALITIES; /* and what of it comes next */
  SDL_LockMutex(p->mutex);
  while (!p->is_ending) {
    if (number == p->order_count && quality == QUALITIES)
      SDL_CondWait(p->changed, p->mutex);
    else if (number == p->order_count && quality == WHOLE)
      SDL_CondWaitTimeout(p->changed, p->mutex, PAUSE_MS);
    if (number != p->order_count) {
      number = p->order_count;
      quality = MOVING;
    }
    if (quality == WHOLE && p->seen <= 1) quality = FINEST;
    if (p->is_ending || quality == QUALITIES) continue;
    const paint_order order = p->order;
    msq_model_retain((msq_model*)order.model);
    SDL_UnlockMutex(p->mutex);
    paint(p, &order, number, quality++);
    msq_model_release((msq_model*)order.model);
    SDL_LockMutex(p->mutex);
  }
  SDL_UnlockMutex(p->mutex);
  return 0;
}

painter* painter_create(Uint32 event) {
  painter* p = calloc(1, sizeof *p);
  if (!p) return NULL;
  p->event = event;
  p->coarseness = 4;
  p->mutex = SDL_CreateMutex();
  p->changed = SDL_CreateCond();
  if (p->mutex && p->changed) p->thread = SDL_CreateThread(run, "painter", p);
  if (p->thread) return p;
  painter_free(p);
  return NULL;
}

void painter_free(painter* p) {
  if (!p) return;
  if (p->thread) {
    SDL_LockMutex(p->mutex);
    p->is_ending = 1;
    if (p->job) msq_job_cancel(p->job);
    SDL_CondSignal(p->changed);
    SDL_UnlockMutex(p->mutex);
    SDL_WaitThread(p->thread, NULL);
  }
  msq_model_release((msq_model*)p->order.model);
  if (p->changed) SDL_DestroyCond(p->changed);
  if (p->mutex) SDL_DestroyMutex(p->mutex);
  free(p->shown);
  free(p->pixels);
  free(p);
}

uint64_t painter_ask(painter* p, const paint_order* order) {
  msq_model_retain((msq_model*)order->model);
  SDL_LockMutex(p->mutex);
  const msq_model* before = p->order.model;
  p->order = *order;
  const uint64_t number = ++p->order_count;
  /* A small picture is let come to its end, or views that move all the time would never show. */
  if (p->job && (p->quality != MOVING || seconds_since(p->began) > LIMIT)) msq_job_cancel(p->job);
  SDL_CondSignal(p->changed);
  SDL_UnlockMutex(p->mutex);
  msq_model_release((msq_model*)before);
  return number;
}

int painter_take(painter* p, SDL_Renderer* renderer, SDL_Texture** texture, paint_report* report,
                 const char** problem) {
  int result = 0;
  SDL_LockMutex(p->mutex);
  if (p->problem[0]) {
    *problem = p->problem;
    result = -1;
  } else if (p->is_new) {
    int width = 0, height = 0;
    if (*texture) SDL_QueryTexture(*texture, NULL, NULL, &width, &height);
    if (width != (int)p->report.width || height != (int)p->report.height) {
      if (*texture) SDL_DestroyTexture(*texture);
      *texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING,
                                   (int)p->report.width, (int)p->report.height);
    }
    result =
        *texture && SDL_UpdateTexture(*texture, NULL, p->shown, (int)(4 * p->report.width)) == 0
            ? 1
            : -1;
    *problem = SDL_GetError();
    *report = p->report;
    p->is_new = 0;
  }
  SDL_UnlockMutex(p->mutex);
  return result;
}
