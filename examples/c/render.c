/* SPDX-License-Identifier: Apache-2.0
 *
 * Renders a part that is filled with a foam, a lattice or a minimal surface, as a PNG. Try:
 * render examples/parts/bracket.stl --fill foam:4:0.2-0.5 -o bracket.png */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "orbit.h"
#include "png_image.h"
#include "render_options.h"
#include "scene.h"
#include "stage.h"

#define TRY(call)                          \
  do {                                     \
    const msq_status status_ = (call);     \
    if (status_ != MSQ_OK) return status_; \
  } while (0)

static msq_status place_camera(const render_options* o, const msq_model* model,
                               msq_camera* camera) {
  double direction[3];
  TRY(msq_camera_init(camera, sizeof *camera));
  if (o->perspective > 0) {
    camera->projection = MSQ_CAMERA_PERSPECTIVE;
    camera->field_of_view = o->perspective;
  }
  orbit_direction(o->azimuth, o->elevation, direction);
  TRY(msq_camera_fit(model, direction, NULL, o->width, o->height, camera));
  const double nearer = 1.06 / o->zoom; /* with a margin */
  camera->height *= nearer;
  for (int a = 0; a < 3; ++a) {
    const double back = camera->eye[a] - camera->target[a];
    if (o->has_at) camera->target[a] = o->at[a];
    camera->eye[a] = camera->target[a] + back * (o->perspective > 0 ? nearer : 1);
  }
  return MSQ_OK;
}

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static msq_status render(const render_options* o, const msq_model* model, const double light[3],
                         const msq_camera* camera, uint8_t* rgba) {
  /* Linear light: the part's own surface, that of a cut, and the structures. */
  static const double colours[] = {0.80, 0.62, 0.40, 0.80, 0.62, 0.40, 0.85, 0.30,
                                   0.05, 0.10, 0.38, 0.55, 0.45, 0.55, 0.12};
  msq_render_def def;
  msq_frame frame;
  TRY(msq_render_def_init(&def, sizeof def));
  TRY(msq_frame_init(&frame, sizeof frame));
  def.width = o->width;
  def.height = o->height;
  def.samples = o->samples;
  def.colour_by = MSQ_COLOUR_SCALE;
  def.colours = o->scene.cut ? colours : colours + 3;
  def.colour_count = 4;
  memcpy(def.light, light, sizeof def.light);
  def.shadows = !o->plain;
  def.ambient = 0.45;
  def.occlusion_rays = o->plain ? 0 : 8; /* per sample; a pixel has several */
  def.tile_width = o->width;
  def.tile_height = 32; /* strips, to show how far it is */
  for (def.tile_y = 0; def.tile_y < o->height; def.tile_y += def.tile_height) {
    if (def.tile_height > o->height - def.tile_y) def.tile_height = o->height - def.tile_y;
    frame.rgba = rgba + 4 * (size_t)def.tile_y * o->width;
    TRY(msq_render(model, camera, &def, NULL, &frame, NULL, NULL, NULL));
    if (isatty(STDERR_FILENO))
      fprintf(stderr, "\r%3.0f %%", 100.0 * (def.tile_y + def.tile_height) / o->height);
  }
  if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
  return MSQ_OK;
}

int main(int argc, char** argv) {
  render_options o;
  const int parsed = render_options_read(&o, argc, argv);
  if (parsed != 0) return parsed < 0 ? 2 : 0;
  scene s;
  msq_model* model = NULL;
  uint8_t *rgba = NULL, *rgb = NULL;
  int failed = scene_open(&s, o.part, o.threshold) || scene_model(&s, &o.scene, &model);
  if (!failed) {
    const double light[3] = {-0.55, 0.75, 0.45}, start = seconds();
    const size_t count = (size_t)o.width * o.height;
    msq_camera camera;
    msq_status status = place_camera(&o, model, &camera);
    if (status == MSQ_OK && !((rgba = malloc(4 * count)) && (rgb = malloc(3 * count))))
      status = MSQ_E_MEMORY;
    if (status == MSQ_OK) status = render(&o, model, light, &camera, rgba);
    const double rendered = seconds();
    const stage around = {model,
                          &camera,
                          o.width,
                          o.height,
                          {light[0], light[1], light[2]},
                          o.glass,
                          s.min[2],
                          !o.plain && o.elevation > 0};
    if (status == MSQ_OK) status = stage_compose(&around, rgba, rgb);
    failed = status != MSQ_OK;
    if (failed) snprintf(s.problem, sizeof s.problem, "%.600s", msq_error_message());
    if (!failed)
      printf("%s: %u x %u pixels in %.2f s, ground and glass in %.2f s\n", o.out, o.width, o.height,
             rendered - start, seconds() - rendered);
  }
  const picture image = {PICTURE_RGB, o.width, o.height, rgb, 3 * (size_t)o.width, 0};
  const int code = failed ? 0 : png_image_save(o.out, &image);
  if (code) snprintf(s.problem, sizeof s.problem, "%.500s: %s", o.out, strerror(code));
  if (failed || code) fprintf(stderr, "render: %s\n", s.problem);
  free(rgba);
  free(rgb);
  msq_model_release(model);
  scene_close(&s);
  return failed || code != 0;
}
