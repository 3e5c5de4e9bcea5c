/* SPDX-License-Identifier: Apache-2.0
 * A part filled with a foam as a mesh, for programs that take nothing else: a binary STL or PLY
 * file, written as msq computes it.
 *
 * usage: preview_mesh PART.stl OUT.stl|OUT.ply [PITCH [CELL_SIZE [RADIUS]]] */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "preview_mesh: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_model* make_model(msq_context* context, const char* part, double cell_size,
                             double radius) {
  msq_shape* shape;
  check(msq_shape_from_file(context, part, NULL, &shape, NULL));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = cell_size;
  foam_def.radius.value = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  const msq_scale_def scales[2] = {{.shape = shape}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_structure_release(foam);
  msq_shape_release(shape);
  return model;
}

typedef struct output {
  FILE* file;
  uint64_t total;
} output;

/* Parts of STL come in order; those of PLY belong to two places that alternate. */
static int32_t write_part(void* user, const msq_file_part* part) {
  output* out = (output*)user;
  out->total = part->total;
  if (fseek(out->file, (long)part->offset, SEEK_SET) != 0) return -1;
  return fwrite(part->bytes, 1, part->size, out->file) == part->size ? 0 : -1;
}

static double number(int argc, char** argv, int index, double otherwise) {
  return argc > index ? strtod(argv[index], NULL) : otherwise;
}

int main(int argc, char** argv) {
  if (argc < 3) {
    fprintf(stderr, "usage: preview_mesh PART.stl OUT.stl|OUT.ply [PITCH [CELL_SIZE [RADIUS]]]\n");
    return 2;
  }
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_model* model =
      make_model(context, argv[1], number(argc, argv, 4, 5), number(argc, argv, 5, 0.5));

  msq_surface_def def;
  check(msq_surface_def_init(&def, sizeof def));
  def.pitch = number(argc, argv, 3, 0.4); /* mm */
  const char* ending = strrchr(argv[2], '.');
  const int32_t format = ending && !strcmp(ending, ".ply") ? MSQ_SURFACE_PLY : MSQ_SURFACE_STL;
  output out = {fopen(argv[2], "wb"), 0};
  if (!out.file) {
    fprintf(stderr, "preview_mesh: cannot write %s\n", argv[2]);
    return 1;
  }
  check(msq_surface_file(model, &def, format, write_part, &out, NULL));
  const int failed = fclose(out.file) != 0;
  printf("%s: %llu bytes\n", argv[2], (unsigned long long)out.total);

  msq_model_release(model);
  msq_context_release(context);
  return failed || out.total < 1000;
}
