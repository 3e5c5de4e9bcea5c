/* SPDX-License-Identifier: Apache-2.0
 * One layer of a plate with a foam in it as an SVG picture: the rings of msq_layer_contours, as a
 * slicer takes them, in whole units of 1e-6 mm.
 *
 * usage: contours_svg [FILE.svg] */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "contours_svg: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* A plate of 40 x 25 x 5 mm: a foam under a skin of 0.8 mm. */
static msq_model* make_plate(msq_context* context) {
  const double min[3] = {0, 0, 0}, max[3] = {40, 25, 5};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 2.5;
  foam_def.radius.value = 0.3;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = foam, .skin = {.value = 0.8}}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_structure_release(foam);
  msq_shape_release(box);
  return model;
}

/* Holes are clockwise, so one path with the rule "nonzero" shows them as holes. */
static void write_svg(FILE* file, const msq_contours_report* rings, double unit) {
  const int64_t* points = (const int64_t*)rings->points; /* pairs */
  fprintf(file,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-1 -1 42 27\" width=\"840\" "
          "height=\"540\">\n<g transform=\"matrix(1 0 0 -1 0 25)\">\n"
          "<path fill=\"#456\" fill-rule=\"nonzero\" d=\"");
  for (uint64_t r = 0; r < rings->ring_count; ++r) {
    for (uint64_t i = rings->starts[r]; i < rings->starts[r + 1]; ++i)
      fprintf(file, "%c%.4f %.4f", i == rings->starts[r] ? 'M' : 'L', (double)points[2 * i] * unit,
              (double)points[2 * i + 1] * unit);
    fprintf(file, "Z\n");
  }
  fprintf(file, "\"/>\n</g>\n</svg>\n");
}

int main(int argc, char** argv) {
  const double units_per_mm = 1e6;
  const char* name = argc > 1 ? argv[1] : "contours.svg";
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_model* model = make_plate(context);

  msq_contours_def def;
  check(msq_contours_def_init(&def, sizeof def));
  def.type = MSQ_INT64;
  def.units = units_per_mm;
  def.tolerance = 0.02; /* mm */
  def.pitch = 0.05;
  msq_contours* contours;
  check(msq_layer_contours(model, 2.5, &def, &contours, NULL));
  msq_contours_report rings = {.struct_size = sizeof rings};
  check(msq_contours_info(contours, &rings));

  FILE* file = fopen(name, "w");
  if (!file) {
    fprintf(stderr, "contours_svg: cannot write %s\n", name);
    return 1;
  }
  write_svg(file, &rings, 1 / units_per_mm);
  const int failed = fclose(file) != 0;
  uint64_t holes = 0;
  for (uint64_t r = 0; r < rings.ring_count; ++r) holes += rings.holes[r];
  printf("%llu rings, %llu of them holes, %llu points\n", (unsigned long long)rings.ring_count,
         (unsigned long long)holes, (unsigned long long)rings.point_count);

  msq_contours_release(contours);
  msq_model_release(model);
  msq_context_release(context);
  return failed || rings.ring_count == 0;
}
