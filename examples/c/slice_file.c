/* SPDX-License-Identifier: Apache-2.0
 * Slices a mesh file that is filled with a foam, and writes every tenth layer as a PBM picture.
 * Almost every viewer of pictures reads PBM, and the bits of a layer are its format.
 *
 * usage: slice_file PART.stl [PREFIX]     writes PREFIX00000.pbm, PREFIX00010.pbm, ... */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_file: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

typedef struct output {
  const char* prefix;
  uint64_t files, pixels;
} output;

/* Runs on the thread that called msq_slicer_run, once per layer, from the bottom to the top. */
static int32_t take_layer(void* user, const msq_layer* layer) {
  output* to = user;
  to->pixels += layer->inside_count;
  if (layer->index % 10 != 0) return 0;
  char path[4096];
  snprintf(path, sizeof path, "%s%05llu.pbm", to->prefix, (unsigned long long)layer->index);
  FILE* file = fopen(path, "wb");
  if (!file) return -1; /* stops the run: msq_slicer_run returns MSQ_E_HOST */
  fprintf(file, "P4\n%u %u\n", layer->width, layer->height);
  for (uint32_t y = layer->height; y-- > 0;) /* row 0 has the smallest y; that of PBM is on top */
    fwrite(layer->data + y * layer->stride, 1, (layer->width + 7) / 8, file);
  ++to->files;
  return ferror(file) | fclose(file) ? -1 : 0;
}

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fprintf(stderr, "usage: slice_file PART.stl [PREFIX]\n");
    return 2;
  }
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_shape* part; /* the format follows from the name of the file */
  check(msq_shape_from_file(context, argv[1], NULL, &part, NULL));
  msq_shape_report info = {.struct_size = sizeof info};
  check(msq_shape_info(part, &info));
  printf("%llu triangles, %s\n", (unsigned long long)info.triangles,
         info.closed ? "closed" : "open");

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 4; /* mm */
  foam_def.radius.value = 0.4;
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

  msq_slicer_def plan_def;
  check(msq_slicer_def_init(&plan_def, sizeof plan_def));
  plan_def.pitch[0] = plan_def.pitch[1] = plan_def.layer_height = 0.2;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan_def, &slicer));
  output files = {argc > 2 ? argv[2] : "layer", 0, 0};
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &files, NULL);
  if (status == MSQ_E_HOST) fprintf(stderr, "slice_file: cannot write %s*\n", files.prefix);
  check(status);
  printf("%llu files; the filled part has %.2f ml\n", (unsigned long long)files.files,
         (double)files.pixels * 0.2 * 0.2 * 0.2 / 1000);

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(part);
  msq_context_release(context);
  return files.pixels == 0;
}
