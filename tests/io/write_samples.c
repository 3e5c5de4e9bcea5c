/* SPDX-License-Identifier: Apache-2.0
 * Writes files by msq_io, and beside them the layers of msq as plain bytes, for the programs that
 * compare the two.
 *
 * usage: write_samples sl1 DIR landscape|portrait MIRROR_X MIRROR_Y
 *        write_samples svg DIR                                            */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "msq_io.h"

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "%s: %s | %s\n", msq_status_name(status), msq_error_message(),
          msq_io_error_message());
  exit(1);
}

/* A box with a foam that no turn or mirror maps to itself. */
static msq_model* make_model(msq_context* context) {
  const double min[3] = {1, 2, 3}, max[3] = {9, 7, 5};
  msq_shape* box;
  msq_structure* foam;
  msq_model* model;
  msq_foam_def foam_def;
  msq_model_def def;
  check(msq_shape_from_box(context, min, max, &box));
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int i = 0; i < 3; ++i) foam_def.grid.cell_size[i] = 1.5;
  foam_def.radius.value = 0.25;
  check(msq_structure_foam(context, &foam_def, &foam));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = foam}};
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  check(msq_model_create(context, &def, &model));
  msq_structure_release(foam);
  msq_shape_release(box);
  return model;
}

typedef struct sink {
  msq_io_writer* writers[2];
  FILE* raw;
} sink;

/* The rows of the first output, without what pads them. */
static int32_t take(void* user, const msq_layer* layer) {
  sink* to = (sink*)user;
  const size_t row = layer->output == MSQ_LAYER_BITS ? (layer->width + 7) / 8 : layer->width;
  for (uint32_t y = 0; y < layer->height; ++y)
    if (fwrite(layer->data + y * layer->stride, 1, row, to->raw) != row) return -1;
  for (int i = 0; i < 2; ++i) {
    const int32_t code = to->writers[i] ? msq_io_writer_layer(to->writers[i], layer) : 0;
    if (code) return code;
  }
  return 0;
}

static void run(msq_slicer* slicer, sink* to) {
  msq_slicer_report plan = {.struct_size = sizeof plan};
  check(msq_slicer_info(slicer, &plan));
  check(msq_slicer_run(slicer, 0, UINT64_MAX, take, to, NULL));
  for (int i = 0; i < 2; ++i) {
    if (to->writers[i]) check(msq_io_writer_finish(to->writers[i]));
    msq_io_writer_release(to->writers[i]);
  }
  fclose(to->raw);
  printf("%u %u %llu\n", (unsigned)plan.width, (unsigned)plan.height,
         (unsigned long long)plan.layer_count);
}

static void write_sl1(msq_model* model, const char* path, FILE* raw, char** words) {
  msq_io_panel_def panel;
  msq_slicer_def def;
  msq_slicer* slicer;
  msq_io_sl1_def sl1;
  sink to = {{NULL, NULL}, raw};
  check(msq_io_panel_def_init(&panel, sizeof panel));
  panel.portrait = strcmp(words[0], "portrait") == 0;
  panel.mirror[0] = atoi(words[1]);
  panel.mirror[1] = atoi(words[2]);
  panel.pixels[0] = 240;
  panel.pixels[1] = 136;
  panel.size[0] = 12;
  panel.size[1] = 6.8;
  check(msq_slicer_def_init(&def, sizeof def));
  def.layer_height = 0.1;
  check(msq_io_panel_plan(model, &panel, &def));
  check(msq_slicer_create(model, &def, &slicer));
  check(msq_io_sl1_def_init(&sl1, sizeof sl1));
  sl1.panel = &panel;
  sl1.job = "sample";
  sl1.created = 1766486645; /* 2025-12-23 10:44:05 */
  sl1.thumbnail_model = model;
  sl1.settings = "gamma_correction = 1\n";
  check(msq_io_sl1_create(slicer, path, NULL, &sl1, &to.writers[0], NULL));
  run(slicer, &to);
  msq_slicer_release(slicer);
}

static void write_svg(msq_model* model, const char* path, const char* files, FILE* raw) {
  msq_slicer_def def;
  msq_slicer* slicer;
  msq_contours_def rings;
  msq_output_def outputs[2];
  msq_io_svg_def svg;
  msq_io_writer_def writer;
  sink to = {{NULL, NULL}, raw};
  check(msq_contours_def_init(&rings, sizeof rings));
  rings.tolerance = 0.004;
  rings.pitch = 0.02;
  rings.type = MSQ_INT32;
  rings.units = 1e5;
  for (int i = 0; i < 2; ++i) check(msq_output_def_init(&outputs[i], sizeof outputs[i]));
  outputs[1].output = MSQ_LAYER_CONTOURS;
  outputs[1].contours = &rings;
  check(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = def.pitch[1] = 0.04;
  def.layer_height = 0.5;
  def.outputs = outputs;
  def.output_count = 2;
  check(msq_slicer_create(model, &def, &slicer));
  check(msq_io_svg_def_init(&svg, sizeof svg));
  svg.units = 1e5;
  check(msq_io_writer_def_init(&writer, sizeof writer));
  writer.output = 1;
  check(msq_io_svg_create(slicer, path, &writer, &svg, &to.writers[0]));
  svg.layout = MSQ_IO_SVG_FILES;
  check(msq_io_svg_create(slicer, files, &writer, &svg, &to.writers[1]));
  run(slicer, &to);
  msq_slicer_release(slicer);
}

int main(int count, char** words) {
  char path[3][512];
  msq_context* context;
  if (count < 3) return 2;
  snprintf(path[0], sizeof path[0], "%s/sample.%s", words[2], words[1]);
  snprintf(path[1], sizeof path[1], "%s/layers.raw", words[2]);
  snprintf(path[2], sizeof path[2], "%s/files", words[2]);
  FILE* raw = fopen(path[1], "wb");
  if (!raw) return 2;
  check(msq_context_create(NULL, &context));
  msq_model* model = make_model(context);
  if (strcmp(words[1], "sl1") == 0)
    write_sl1(model, path[0], raw, words + 3);
  else
    write_svg(model, path[0], path[2], raw);
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}
