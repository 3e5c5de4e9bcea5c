/* SPDX-License-Identifier: Apache-2.0
 * Cameras, and pictures with every array, that the tests of rendering share. */
#ifndef CAMERAS_H
#define CAMERAS_H

#include "definitions.h"

static inline msq_camera camera_at(int32_t projection, double x, double y, double z) {
  msq_camera camera;
  assert_ok(msq_camera_init(&camera, sizeof camera));
  camera.projection = projection;
  camera.eye[0] = x;
  camera.eye[1] = y;
  camera.eye[2] = z;
  return camera;
}

/* That sees all of the model, from the front, the right and above. */
static inline msq_camera fitted_camera(const msq_model* model, int32_t projection, uint32_t width,
                                       uint32_t height) {
  const double direction[3] = {-0.5, 0.8, -0.4};
  msq_camera camera;
  assert_ok(msq_camera_init(&camera, sizeof camera));
  camera.projection = projection;
  assert_ok(msq_camera_fit(model, direction, NULL, width, height, &camera));
  return camera;
}

static inline msq_render_def render_def(uint32_t width, uint32_t height) {
  msq_render_def def;
  assert_ok(msq_render_def_init(&def, sizeof def));
  def.width = width;
  def.height = height;
  return def;
}

/* Arrays of a frame, in one block of bytes. */
typedef struct picture {
  uint32_t width, height;
  size_t bytes;
  unsigned char* data;
  msq_frame frame;
} picture;

enum { bytes_per_pixel = 4 + 12 + 4 + 4 + 4, unwritten = 0xa5 };

static inline picture make_picture(uint32_t width, uint32_t height) {
  const size_t pixels = (size_t)width * height;
  picture made;
  made.width = width;
  made.height = height;
  made.bytes = pixels * bytes_per_pixel;
  made.data = (unsigned char*)malloc(made.bytes);
  assert_non_null(made.data);
  memset(made.data, unwritten, made.bytes);
  assert_ok(msq_frame_init(&made.frame, sizeof made.frame));
  made.frame.depth = (float*)made.data;
  made.frame.normal = made.frame.depth + pixels;
  made.frame.scale = (int32_t*)(made.frame.normal + 3 * pixels);
  made.frame.material = (uint32_t*)(made.frame.scale + pixels);
  made.frame.rgba = (uint8_t*)(made.frame.material + pixels);
  return made;
}

static inline void free_picture(picture* which) {
  free(which->data);
}

/* The same to the last bit. */
static inline void assert_same_picture(const picture* a, const picture* b) {
  const size_t pixels = (size_t)a->width * a->height;
  assert_int_equal(a->bytes, b->bytes);
  assert_memory_equal(a->frame.depth, b->frame.depth, 4 * pixels);
  assert_memory_equal(a->frame.normal, b->frame.normal, 12 * pixels);
  assert_memory_equal(a->frame.scale, b->frame.scale, 4 * pixels);
  assert_memory_equal(a->frame.material, b->frame.material, 4 * pixels);
  assert_memory_equal(a->frame.rgba, b->frame.rgba, 4 * pixels);
}

static inline picture rendered(const msq_model* model, const msq_camera* camera,
                               const msq_render_def* def) {
  const int is_whole = def->tile_width == 0;
  picture made = make_picture(is_whole ? def->width : def->tile_width,
                              is_whole ? def->height : def->tile_height);
  assert_ok(msq_render(model, camera, def, NULL, &made.frame, NULL, NULL, NULL));
  return made;
}

#endif
