/* SPDX-License-Identifier: Apache-2.0
 * Slices a voxel image, for example a CT scan. It is solid from a threshold on, and a foam fills it
 * whose struts are thicker where the image is brighter. Every tenth layer becomes a PBM picture.
 * Files in NRRD and TIFF are read by model files (docs/model_file.md).
 *
 * usage: slice_voxels FILE.raw NX,NY,NZ SPACING THRESHOLD [PREFIX]
 *   FILE.raw: NX * NY * NZ values of 16 bits with sign, in the byte order of the machine, x fastest
 * Try: python3 examples/parts/make_bone.py bone.nhdr && slice_voxels bone.raw 57,37,69 1 250 */
#include <inttypes.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_voxels: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* Reads a raw file into memory of its own, which must be free()d. NULL if it is not of that size.
 */
static int16_t* read_values(const char* path, const uint64_t size[3]) {
  for (int axis = 0; axis < 3; ++axis)
    if (size[axis] < 1 || size[axis] > 4096) return NULL;
  const size_t count = (size_t)(size[0] * size[1] * size[2]);
  FILE* file = fopen(path, "rb");
  int16_t* values = file ? malloc(count * sizeof *values) : NULL;
  const int is_whole =
      values && fread(values, sizeof *values, count, file) == count && fgetc(file) == EOF;
  if (file) fclose(file);
  if (is_whole) return values;
  free(values);
  return NULL;
}

typedef struct output {
  const char* prefix;
  uint64_t pixels;
} output;

static int32_t take_layer(void* user, const msq_layer* layer) {
  output* to = user;
  to->pixels += layer->inside_count;
  if (layer->index % 10 != 0) return 0;
  char path[4096];
  snprintf(path, sizeof path, "%s%05" PRIu64 ".pbm", to->prefix, layer->index);
  FILE* file = fopen(path, "wb");
  if (!file) return -1; /* stops the run: msq_slicer_run returns MSQ_E_HOST */
  fprintf(file, "P4\n%u %u\n", layer->width, layer->height);
  for (uint32_t y = layer->height; y-- > 0;)
    fwrite(layer->data + y * layer->stride, 1, (layer->width + 7) / 8, file);
  return ferror(file) | fclose(file) ? -1 : 0;
}

int main(int argc, char** argv) {
  msq_voxels_def voxels;
  check(msq_voxels_def_init(&voxels, sizeof voxels));
  uint64_t* const size = voxels.image.size;
  if (argc < 5 || argc > 6 ||
      sscanf(argv[2], "%" SCNu64 ",%" SCNu64 ",%" SCNu64, size, size + 1, size + 2) != 3) {
    fputs("usage: slice_voxels FILE.raw NX,NY,NZ SPACING THRESHOLD [PREFIX]\n", stderr);
    return 2;
  }
  int16_t* values = read_values(argv[1], size);
  if (!values) {
    fprintf(stderr, "slice_voxels: %s: cannot read %s values of 16 bits\n", argv[1], argv[2]);
    return 1;
  }

  /* The image is the coarse shape and, through a curve, the radius of the struts. */
  msq_context* context;
  check(msq_context_create(NULL, &context));
  voxels.image.values = values;
  voxels.image.value_type = MSQ_INT16;
  for (int axis = 0; axis < 3; ++axis) voxels.image.grid.cell_size[axis] = atof(argv[3]);
  voxels.threshold = atof(argv[4]);
  msq_shape* part;
  check(msq_shape_from_voxels(context, &voxels, &part));
  msq_grid_field_def grid;
  check(msq_grid_field_def_init(&grid, sizeof grid));
  grid.image = voxels.image;
  msq_field *grey, *radius;
  check(msq_field_grid(context, &grid, &grey));
  free(values); /* msq has copies */
  /* mm by Hounsfield units: dense bone is about 1500 above the threshold. */
  const double curve[4] = {voxels.threshold, 0.35, voxels.threshold + 1500, 1.4};
  check(msq_field_map(context, grey, curve, 2, &radius));

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 3;
  foam_def.radius.field = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));
  const msq_scale_def scales[2] = {{.shape = part}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  const double pitch = 0.25;
  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = pitch;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  output files = {argc > 5 ? argv[5] : "layer", 0};
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &files, NULL);
  if (status == MSQ_E_HOST) fprintf(stderr, "slice_voxels: cannot write %s*\n", files.prefix);
  check(status);

  msq_shape_report facts = {.struct_size = sizeof facts};
  check(msq_shape_info(part, &facts));
  printf("%.1f %% of %.2f cm3 filled\n",
         100 * (double)files.pixels * pitch * pitch * pitch / facts.volume, facts.volume / 1000);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_field_release(radius);
  msq_field_release(grey);
  msq_shape_release(part);
  msq_context_release(context);
  return 0;
}
