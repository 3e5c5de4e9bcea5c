/* SPDX-License-Identifier: Apache-2.0
 * Slices a mesh file that is filled with a foam, thicker upwards, into a folder of PNG files. The
 * writer of msq_io is the callback of the run: its threads encode while msq computes. The command
 * msq slice does the same with options.
 *
 * usage: slice_stl PART.stl FOLDER     writes FOLDER/layer00000.png, FOLDER/layer00001.png, ... */
#include <msq.h>
#include <msq_io.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_stl: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* Functions of msq_io have a message of their own. */
static void check_io(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_stl: %s: %s\n", msq_status_name(status), msq_io_error_message());
  exit(1);
}

/* The part, filled. Objects keep what they are made of, so each is released once it is used. */
static msq_model* make_model(msq_context* context, const char* path) {
  msq_shape* part;
  check(msq_shape_from_file(context, path, NULL, &part, NULL));
  msq_shape_report size = {.struct_size = sizeof size};
  check(msq_shape_info(part, &size));
  printf("%llu triangles, %s; %.4g x %.4g x %.4g mm\n", (unsigned long long)size.triangles,
         size.closed ? "closed" : "open", size.max[0] - size.min[0], size.max[1] - size.min[1],
         size.max[2] - size.min[2]);

  const double bottom[3] = {0, 0, size.min[2]}, top[3] = {0, 0, size.max[2]};
  msq_field* radius;
  check(msq_field_gradient(context, bottom, 0.2, top, 0.5, &radius));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 4;
  foam_def.radius.field = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  const msq_scale_def scales[2] = {{.shape = part}, {.structure = foam}};
  msq_model_def def;
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &def, &model));
  msq_structure_release(foam);
  msq_field_release(radius);
  msq_shape_release(part);
  return model;
}

int main(int argc, char** argv) {
  if (argc != 3) {
    fputs("usage: slice_stl PART.stl FOLDER\n", stderr);
    return 2;
  }
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_model* model = make_model(context, argv[1]);

  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = 0.1;
  plan.orientation = MSQ_LAYER_MIRROR_Y; /* the first row of a picture is its top */
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));

  msq_io_writer_def files;
  check_io(msq_io_writer_def_init(&files, sizeof files));
  files.replace = 1;
  msq_io_writer* writer;
  check_io(msq_io_png_create(slicer, argv[2], &files, NULL, &writer));
  const msq_status status =
      msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, NULL);
  if (status != MSQ_E_HOST) check(status); /* HOST: the writer has failed, and says why */
  check_io(msq_io_writer_finish(writer));

  msq_io_writer_report written = {.struct_size = sizeof written};
  check_io(msq_io_writer_info(writer, &written));
  printf("%llu files, %.1f MB\n", (unsigned long long)written.written_count,
         1e-6 * (double)written.bytes);
  msq_io_writer_release(writer);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}
