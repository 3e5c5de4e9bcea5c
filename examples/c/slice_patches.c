/* SPDX-License-Identifier: Apache-2.0
 *
 * Slices a structure that the host computes: a block of voxels, continued without end (patches.c).
 * Try: slice_patches picture.png */
#include <math.h>
#include <msq_io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "patches.h"

enum { pixels = 512 };

static const char usage[] =
    "usage: slice_patches PICTURE.png [BLOCK.raw]\n"
    "Writes one layer as a picture. BLOCK.raw: 32 x 32 x 32 bytes, grey values, x first\n";

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_patches: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

int main(int argc, char** argv) {
  static block example;
  if (argc > 1 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
    fputs(usage, stdout);
    return 0;
  }
  if (argc < 2 || argc > 3 || argv[1][0] == '-') {
    fputs(usage, stderr);
    return 2;
  }
  if (block_read(argc > 2 ? argv[2] : NULL, &example) != 0) {
    fprintf(stderr, "slice_patches: %s: cannot read 32 x 32 x 32 bytes\n", argv[2]);
    return 1;
  }
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {0, 0, 0}, max[3] = {8, 8, 0.5};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));
  msq_host_structure_def def;
  check(msq_host_structure_def_init(&def, sizeof def));
  patches_define(&example, &def);
  msq_structure* structure;
  check(msq_structure_host(context, &def, &structure));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = structure}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_slicer_def slicer_def;
  check(msq_slicer_def_init(&slicer_def, sizeof slicer_def));
  slicer_def.output = MSQ_LAYER_BYTES;
  slicer_def.resolution[0] = slicer_def.resolution[1] = pixels;
  slicer_def.layer_height = 0.5;
  slicer_def.orientation = MSQ_LAYER_MIRROR_Y; /* the first row of a picture is its top */
  msq_slicer* slicer;
  check(msq_slicer_create(model, &slicer_def, &slicer));
  static uint8_t layer[pixels * pixels];
  check(msq_slice_layer(slicer, 0, layer, sizeof layer, NULL));

  double of_block = 0, of_layer = 0;
  for (int v = 0; v < block_voxels; ++v)
    of_block += (example.grey[v] >= block_solid) / (double)block_voxels;
  for (int p = 0; p < pixels * pixels; ++p) of_layer += layer[p] / 255.0 / (pixels * pixels);
  printf("solid: %.3f of the block, %.3f of the layer\n", of_block, of_layer);
  const msq_status status = msq_io_picture_save(argv[1], pixels, pixels, 1, layer, 0, 1);
  if (status != MSQ_OK) fprintf(stderr, "slice_patches: %s\n", msq_io_error_message());
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(structure);
  msq_shape_release(box);
  msq_context_release(context);
  return status != MSQ_OK || fabs(of_block - of_layer) > 0.05;
}
