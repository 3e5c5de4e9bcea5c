/* SPDX-License-Identifier: Apache-2.0
 * A picture by rays, without a mesh: a cylinder filled with gyroids, with shadows, as a PPM file.
 *
 * usage: ray_picture [FILE.ppm] */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "ray_picture: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

enum { width = 480, height = 400 };
static uint8_t rgba[height][width][4];
static float depths[height][width]; /* infinite where nothing is hit */

static int save(const char* path) {
  FILE* file = fopen(path, "wb");
  if (!file) return -1;
  fprintf(file, "P6\n%d %d\n255\n", width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) fwrite(rgba[y][x], 1, 3, file);
  const int failed = ferror(file);
  return fclose(file) != 0 || failed ? -1 : 0;
}

int main(int argc, char** argv) {
  const char* path = argc > 1 ? argv[1] : "picture.ppm";
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 24};
  msq_shape* cylinder;
  check(msq_shape_from_cylinder(context, from, to, 14, &cylinder));
  msq_functional_def gyroid_def;
  check(msq_functional_def_init(&gyroid_def, sizeof gyroid_def));
  gyroid_def.kind = MSQ_FUNCTIONAL_SHEET;
  gyroid_def.thickness.value = 1;
  for (int axis = 0; axis < 3; ++axis) gyroid_def.grid.cell_size[axis] = 8;
  msq_structure* gyroid;
  check(msq_structure_functional(context, &gyroid_def, &gyroid));
  const msq_scale_def scales[2] = {{.shape = cylinder}, {.structure = gyroid}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_camera camera;
  check(msq_camera_init(&camera, sizeof camera));
  const double view[3] = {-0.5, -0.7, -0.5}; /* from the eye to the part */
  check(msq_camera_fit(model, view, NULL, width, height, &camera));

  msq_render_def def;
  check(msq_render_def_init(&def, sizeof def));
  def.width = width;
  def.height = height;
  def.samples = 2; /* 2 x 2 rays per pixel */
  def.shadows = 1;
  for (int i = 0; i < 4; ++i) def.background[i] = 1;
  msq_frame frame;
  check(msq_frame_init(&frame, sizeof frame));
  frame.rgba = &rgba[0][0][0];
  frame.depth = &depths[0][0];
  check(msq_render(model, &camera, &def, NULL, &frame, NULL, NULL, NULL));

  int hits = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) hits += depths[y][x] < 1e30f;
  const int failed = save(path);
  if (failed) fprintf(stderr, "ray_picture: cannot write %s\n", path);
  printf("%s: %d of %d pixels show the part\n", path, hits, width * height);

  msq_model_release(model);
  msq_structure_release(gyroid);
  msq_shape_release(cylinder);
  msq_context_release(context);
  return failed != 0 || hits < width * height / 4 || hits > width * height * 9 / 10;
}
