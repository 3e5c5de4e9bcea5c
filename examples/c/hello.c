/* SPDX-License-Identifier: Apache-2.0
 *
 * The smallest msq program: fills a box with a strut lattice and prints one layer as text. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

/* Every function that can fail returns a status. The message tells what was wrong. */
static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "hello: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

int main(void) {
  msq_context* context; /* threads, cache and memory limit of all objects; NULL: defaults */
  check(msq_context_create(NULL, &context));

  const double min[3] = {0, 0, 0}, max[3] = {36, 18, 9}; /* the coarse shape, in mm */
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));

  msq_lattice_def lattice_def; /* init sets the size of the struct and the defaults */
  check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.unit_cell = MSQ_UNIT_CELL_BCC; /* struts from each cell's centre to its corners */
  for (int axis = 0; axis < 3; ++axis) lattice_def.grid.cell_size[axis] = 9;
  lattice_def.radius.value = 0.9;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &lattice_def, &lattice));

  /* The model is the intersection of its scales, coarsest first. */
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = lattice}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_slicer_def slicer_def; /* 72 x 18 pixels, twice as high as wide, like characters */
  check(msq_slicer_def_init(&slicer_def, sizeof slicer_def));
  slicer_def.output = MSQ_LAYER_BYTES;
  slicer_def.resolution[0] = 72;
  slicer_def.resolution[1] = 18;
  slicer_def.layer_height = 0.5;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &slicer_def, &slicer));
  static uint8_t pixels[18][72]; /* row 0 has the smallest y, so it is printed last */
  check(msq_slice_layer(slicer, 5, &pixels[0][0], sizeof pixels, NULL));
  for (int y = 17; y >= 0; --y, putchar('\n'))
    for (int x = 0; x < 72; ++x) putchar(pixels[y][x] ? '#' : '.');

  msq_slicer_release(slicer); /* in any order: each retains what it was built from */
  msq_model_release(model);
  msq_structure_release(lattice);
  msq_shape_release(box);
  msq_context_release(context);
  return 0;
}
