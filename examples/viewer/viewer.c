/* SPDX-License-Identifier: Apache-2.0
 *
 * Shows a part filled with foams, lattices and minimal surfaces in a window. Drag to turn it, use
 * the wheel to zoom, and keys 1 to 7 to select the filling. Try: viewer examples/parts/bracket.stl
 */
#include <SDL.h>
#include <math.h>
#include <msq_io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "overlay.h"
#include "painter.h"
#include "pose.h"
#include "scene.h"
#include "script.h"

static const char usage[] =
    "usage: viewer [PART] [options]\n"
    "  PART          a mesh file, a model file (.json), or block:MM (default: the bracket of the "
    "examples)\n"
    "  --fill LIST   structure of key 0: foam:4:0.4, octet:12:1.8+gyroid:1.2 and so on (default:\n"
    "                that of the model file)\n"
    "  --skin MM     solid skin\n"
    "  --size W H    of the window (default 960 720)\n"
    "  --script TEXT " SCRIPT_HELP "\n";

static const char help[] =
    "DRAG: TURN\nRIGHT DRAG: PAN   WHEEL: ZOOM\n"
    "1-7: STRUCTURE\n[ ]: COARSER, FINER SCALES\n"
    "O: SHADOWS   P: PERSPECTIVE\nSPACE: SPIN   R: RESET\n"
    "H: HELP   Q: QUIT";

enum { FILLS = 8 };

typedef struct viewer {
  SDL_Window* window;
  SDL_Renderer* renderer;
  SDL_Texture* texture;
  painter* painter;
  Uint32 event;
  scene scene;
  scene_def fills[FILLS];
  int fill;
  msq_model* model;
  uint32_t scales, resolved; /* structures of the model, and those that are shown */
  pose pose;
  int is_spinning, has_shadows, has_help;
  uint64_t order;
  paint_report shown;
  Uint64 last_picture;
  double rate; /* pictures a second of the moving view */
  int is_over;
} viewer;

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "viewer: %s\n", msq_error_message());
  exit(1);
}

static void ask(viewer* v) {
  paint_order order = {.model = v->model, .has_shadows = v->has_shadows};
  check(pose_camera(&v->pose, &order.camera));
  order.width = (uint32_t)v->pose.window[0];
  order.height = (uint32_t)v->pose.window[1];
  if (v->resolved < v->scales)
    check(msq_model_scale_length(v->model, v->resolved, &order.length_scale));
  v->order = painter_ask(v->painter, &order);
}

static int choose_fill(viewer* v, int fill) {
  msq_model* model = NULL;
  if (!v->fills[fill].fill) return 0;
  if (scene_model(&v->scene, &v->fills[fill], &model) != 0) {
    fprintf(stderr, "viewer: %s\n", v->scene.problem);
    return -1;
  }
  msq_model_release(v->model);
  v->model = model;
  v->fill = fill;
  v->scales = 0;
  for (double length; msq_model_scale_length(model, v->scales + 1, &length) == MSQ_OK;) ++v->scales;
  v->resolved = v->scales;
  return 0;
}

/* Returns 1 where the view has changed. */
static int take_key(viewer* v, SDL_Keycode key) {
  if (key == SDLK_q || key == SDLK_ESCAPE) v->is_over = 1;
  if (key == SDLK_h) v->has_help = !v->has_help;
  if (key == SDLK_SPACE) v->is_spinning = !v->is_spinning;
  if (key == SDLK_p) v->pose.is_perspective = !v->pose.is_perspective;
  if (key == SDLK_o) v->has_shadows = !v->has_shadows;
  if (key == SDLK_r) pose_reset(&v->pose, v->scene.min, v->scene.max);
  if (key >= SDLK_0 && key < SDLK_0 + FILLS) choose_fill(v, key - SDLK_0);
  if (key == SDLK_LEFTBRACKET && v->resolved > 0) --v->resolved;
  if (key == SDLK_RIGHTBRACKET && v->resolved < v->scales) ++v->resolved;
  return 1;
}

static int take_event(viewer* v, const SDL_Event* event) {
  int x, y;
  switch (event->type) {
    case SDL_QUIT:
      v->is_over = 1;
      return 0;
    case SDL_WINDOWEVENT:
      SDL_GetRendererOutputSize(v->renderer, &x, &y);
      if (x == v->pose.window[0] && y == v->pose.window[1]) return 0;
      v->pose.window[0] = x;
      v->pose.window[1] = y;
      return 1;
    case SDL_MOUSEMOTION:
      if (event->motion.state & SDL_BUTTON_LMASK && !(SDL_GetModState() & KMOD_SHIFT))
        pose_turn(&v->pose, event->motion.xrel, event->motion.yrel);
      else if (event->motion.state)
        check(pose_pan(&v->pose, event->motion.xrel, event->motion.yrel));
      return event->motion.state != 0;
    case SDL_MOUSEWHEEL:
      SDL_GetMouseState(&x, &y);
      if (SDL_GetMouseFocus() != v->window) x = v->pose.window[0] / 2, y = v->pose.window[1] / 2;
      check(pose_zoom(&v->pose, event->wheel.y, x, y));
      return 1;
    case SDL_KEYDOWN:
      return take_key(v, event->key.keysym.sym);
    default:
      return 0;
  }
}

/* Takes a picture if there is a new one, and turns a spinning part. As painter_take. */
static int take_picture(viewer* v) {
  const char* problem;
  const int taken = painter_take(v->painter, v->renderer, &v->texture, &v->shown, &problem);
  if (taken < 0) fprintf(stderr, "viewer: %s\n", problem);
  if (taken <= 0 || !v->shown.is_moving) return taken;
  const Uint64 now = SDL_GetPerformanceCounter();
  const double seconds = (double)(now - v->last_picture) / (double)SDL_GetPerformanceFrequency();
  /* A view that begins to move has no rate yet. */
  const double rate = seconds > 0.5 ? 1 / v->shown.seconds : 1 / seconds;
  v->rate = seconds > 0.5 ? rate : v->rate + 0.2 * (rate - v->rate);
  v->last_picture = now;
  if (v->is_spinning) {
    v->pose.azimuth += 40 * fmin(seconds, 0.1);
    ask(v);
  }
  return taken;
}

static void draw(viewer* v) {
  char text[512], title[600], quality[64];
  if (v->shown.is_moving)
    snprintf(quality, sizeof quality, "%.1f FPS  1/%.1f", v->rate, v->shown.coarseness);
  else
    snprintf(quality, sizeof quality, "%.1f FPS  %s", v->rate,
             v->shown.is_last ? "FINE" : "REFINING");
  snprintf(text, sizeof text, "%s\n%s\nSCALES %u/%u%s%s", quality, v->fills[v->fill].fill,
           v->resolved, v->scales, v->has_help ? "\n\n" : "   H: HELP", v->has_help ? help : "");
  SDL_SetRenderDrawColor(v->renderer, 231, 235, 240, 255);
  SDL_RenderClear(v->renderer);
  SDL_RenderCopy(v->renderer, v->texture, NULL, NULL);
  overlay_write(v->renderer, 10, 10, 2, text);
  snprintf(title, sizeof title, "msq viewer: %s, %.1f pictures a second", v->fills[v->fill].fill,
           v->rate);
  SDL_SetWindowTitle(v->window, title);
}

/* Saves what draw has drawn. */
static int save_window(const viewer* v, const char* path) {
  const size_t stride = 3 * (size_t)v->pose.window[0];
  uint8_t* pixels = malloc(stride * (size_t)v->pose.window[1]);
  int failed = !pixels || SDL_RenderReadPixels(v->renderer, NULL, SDL_PIXELFORMAT_RGB24, pixels,
                                               (int)stride) != 0;
  if (failed) fprintf(stderr, "viewer: %s: %s\n", path, pixels ? SDL_GetError() : "out of memory");
  if (!failed) {
    failed = msq_io_picture_save(path, (uint32_t)v->pose.window[0], (uint32_t)v->pose.window[1], 3,
                                 pixels, stride, 1) != MSQ_OK;
    if (failed) fprintf(stderr, "viewer: %s\n", msq_io_error_message());
  }
  free(pixels);
  return failed;
}

static int run(viewer* v, const char* text) {
  script commands = {.at = text ? text : ""};
  int failed = 0;
  ask(v);
  while (!v->is_over && !failed) {
    SDL_Event event;
    int has_event = SDL_WaitEventTimeout(&event, 20), is_changed = 0, is_dirty = has_event;
    for (; has_event; has_event = SDL_PollEvent(&event)) is_changed |= take_event(v, &event);
    if (is_changed && !v->is_over) ask(v);
    const int taken = take_picture(v);
    failed = taken < 0;
    is_dirty |= taken > 0;
    if (is_dirty && v->texture) draw(v);
    if (text && v->texture) {
      char file[1024];
      const int is_drawn = v->is_spinning ? taken > 0 : v->shown.order == v->order;
      const int action =
          script_go(&commands, is_drawn, is_drawn && v->shown.is_last, file, sizeof file);
      failed |= action == SCRIPT_ERROR;
      if (action == SCRIPT_SHOT) {
        draw(v);
        failed = save_window(v, file);
      }
    }
    if (is_dirty && v->texture) SDL_RenderPresent(v->renderer);
  }
  return failed;
}

static int open_window(viewer* v) {
  /* The picture is drawn by the processor: what shows it need not be fast, but must always work. */
  SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
  if (SDL_Init(SDL_INIT_VIDEO) != 0) return -1;
  v->event = SDL_RegisterEvents(1);
  v->window = SDL_CreateWindow("msq viewer", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                               v->pose.window[0], v->pose.window[1], SDL_WINDOW_RESIZABLE);
  if (!v->window) return -1;
  v->renderer = SDL_CreateRenderer(v->window, -1, 0);
  if (!v->renderer) v->renderer = SDL_CreateRenderer(v->window, -1, SDL_RENDERER_SOFTWARE);
  if (!v->renderer) return -1;
  SDL_GetRendererOutputSize(v->renderer, &v->pose.window[0], &v->pose.window[1]);
  v->painter = painter_create(v->event);
  return v->painter ? 0 : -1;
}

static void close_window(viewer* v) {
  painter_free(v->painter);
  if (v->texture) SDL_DestroyTexture(v->texture);
  if (v->renderer) SDL_DestroyRenderer(v->renderer);
  if (v->window) SDL_DestroyWindow(v->window);
  SDL_Quit();
}

int main(int argc, char** argv) {
  static const char* const fills[FILLS] = {NULL,
                                           "foam:4:0.35",
                                           "foam:4:0.15-0.6",
                                           "octet:6:0.5",
                                           "gyroid:6:0.6",
                                           "octet:12:1.8+gyroid:1.2",
                                           "foam:16:1.6+foam:2:0.2",
                                           "kelvin:6:0.4"};
  viewer v = {.pose.window = {960, 720}, .fill = 1, .has_shadows = 1};
  const char *part = MSQ_EXAMPLE_PART, *text = NULL;
  double skin = 0;
  for (int i = 1; i < argc; ++i) {
    const int has_value = i + 1 < argc;
    if (strcmp(argv[i], "--fill") == 0 && has_value) {
      v.fills[0].fill = argv[++i];
      v.fill = 0;
    } else if (strcmp(argv[i], "--skin") == 0 && has_value) {
      skin = atof(argv[++i]);
    } else if (strcmp(argv[i], "--size") == 0 && i + 2 < argc) {
      v.pose.window[0] = atoi(argv[++i]);
      v.pose.window[1] = atoi(argv[++i]);
    } else if (strcmp(argv[i], "--script") == 0 && has_value) {
      text = argv[++i];
    } else if (argv[i][0] != '-') {
      part = argv[i];
    } else {
      return fputs(usage, stderr), 2;
    }
  }
  for (int i = 0; i < FILLS; ++i) {
    if (i > 0) v.fills[i].fill = fills[i];
    v.fills[i].skin = skin;
  }
  int failed = 0;
  if (scene_open(&v.scene, part) != 0) {
    fprintf(stderr, "viewer: %s\n", v.scene.problem);
    failed = 1;
  }
  if (!failed && v.scene.model && !v.fills[0].fill) {
    v.fills[0].fill = SCENE_OWN;
    v.fill = 0;
  }
  if (!failed) failed = choose_fill(&v, v.fill) != 0;
  if (!failed && open_window(&v) != 0) {
    fprintf(stderr, "viewer: %s\n", SDL_GetError());
    failed = 1;
  }
  if (!failed) {
    pose_reset(&v.pose, v.scene.min, v.scene.max);
    failed = run(&v, text);
  }
  close_window(&v);
  msq_model_release(v.model);
  scene_close(&v.scene);
  return failed;
}
