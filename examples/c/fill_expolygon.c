/* SPDX-License-Identifier: Apache-2.0
 * Infill for filament, as an infill class of a slicer would call msq: the slicer has a polygon with
 * holes in whole nanometres for each layer, a line width and a density, and wants open and closed
 * polylines. Prints the density of a stack of layers; draws one as SVG.
 *
 *   fill_expolygon foam|gyroid|graded [density [layer.svg]]
 *
 * graded: a gyroid whose cells grow to twice their length from the left to the right.
 */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double scale = 1e-6; /* mm in a nanometre */

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "fill_expolygon: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* What does not change from layer to layer is made once for an object that is sliced. */
typedef struct infill {
  msq_context* context;
  msq_structure* pattern;
} infill;

enum pattern { foam, gyroid, graded };

static msq_structure* make_pattern(msq_context* context, enum pattern kind, const double cell[3]) {
  msq_structure* pattern;
  if (kind == foam) {
    msq_foam_def def;
    check(msq_foam_def_init(&def, sizeof def));
    memcpy(def.grid.cell_size, cell, sizeof def.grid.cell_size);
    def.radius.value = 0.01 * cell[0]; /* of struts: no matter for lines */
    check(msq_structure_foam(context, &def, &pattern));
  } else {
    msq_functional_def def;
    check(msq_functional_def_init(&def, sizeof def));
    memcpy(def.grid.cell_size, cell, sizeof def.grid.cell_size);
    def.function = MSQ_FUNCTION_GYROID;
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.level.value = 0.1; /* no matter for lines */
    const double positions[2] = {0, 60}, sizes[2] = {cell[0], 2 * cell[0]};
    msq_period_def period;
    check(msq_period_def_init(&period, sizeof period));
    period.axis = 0;
    period.positions = positions;
    period.cell_sizes = sizes;
    period.count = 2;
    if (kind == graded) def.period = &period;
    check(msq_structure_functional(context, &def, &pattern));
  }
  return pattern;
}

static infill make_infill(enum pattern kind, double line_width, double density) {
  infill made;
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.threads = 1; /* the slicer fills layers on threads of its own */
  check(msq_context_create(&def, &made.context));

  double cell[3] = {1, 1, 1}; /* of any size: calibration gives that of the density */
  msq_structure* unit = make_pattern(made.context, kind == foam ? foam : gyroid, cell);
  check(msq_fill_calibrate(made.context, unit, line_width, density, cell, NULL));
  msq_structure_release(unit);
  made.pattern = make_pattern(made.context, kind, cell);
  printf("cells of %.3f mm\n", cell[0]);
  return made;
}

/* Any thread may call this, several at once. */
static msq_fill* fill_layer(const infill* infill, const msq_ring* expolygon, uint64_t rings,
                            double z, double line_width) {
  msq_fill_def def;
  check(msq_fill_def_init(&def, sizeof def));
  def.coordinate_type = MSQ_INT64;
  def.rings = expolygon;
  def.ring_count = rings;
  def.scale = scale;
  def.z = z;
  def.tolerance = 0.0125;
  def.min_length = 0.8 * line_width;
  msq_fill* fill;
  check(msq_fill_lines(infill->context, infill->pattern, &def, &fill, NULL));
  return fill;
}

static void draw(const char* file, const msq_fill_report* paths, double line_width) {
  FILE* out = fopen(file, "w");
  if (!out) {
    perror(file);
    exit(1);
  }
  fprintf(out,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-1 -1 62 42\" width=\"930\" "
          "height=\"630\" fill=\"none\" stroke-linejoin=\"round\" stroke=\"#246\" "
          "stroke-width=\"%g\">\n",
          line_width);
  const int64_t* points = paths->points;
  for (uint64_t p = 0; p < paths->path_count; ++p) {
    fputs(paths->closed[p] ? "<polygon points=\"" : "<polyline points=\"", out);
    for (uint64_t i = paths->path_starts[p]; i < paths->path_starts[p + 1]; ++i)
      fprintf(out, "%.4f,%.4f ", (double)points[2 * i] * scale,
              40 - (double)points[2 * i + 1] * scale);
    fputs("\"/>\n", out);
  }
  fputs("</svg>\n", out);
  fclose(out);
}

int main(int argc, char** argv) {
  const char* name = argc > 1 ? argv[1] : "foam";
  const enum pattern kind = !strcmp(name, "gyroid")   ? gyroid
                            : !strcmp(name, "graded") ? graded
                                                      : foam;
  const double density = argc > 2 ? atof(argv[2]) : 0.15, line_width = 0.45, layer_height = 0.2;
  /* 60 x 40 mm with a hole. Rings may run either way, and may be where the slicer keeps them. */
  static const int64_t contour[4][2] = {{0, 0}, {60000000, 0}, {60000000, 40000000}, {0, 40000000}};
  static const int64_t hole[4][2] = {
      {20000000, 12000000}, {16000000, 28000000}, {34000000, 30000000}, {38000000, 14000000}};
  const msq_ring expolygon[2] = {{contour, 4}, {hole, 4}};
  const double area = 60 * 40 - 280; /* mm^2 */

  infill infill = make_infill(kind, line_width, density);
  double length = 0, travel = 0;
  uint64_t count = 0;
  const int layers = 200;
  for (int layer = 0; layer < layers; ++layer) {
    msq_fill* fill = fill_layer(&infill, expolygon, 2, (layer + 0.5) * layer_height, line_width);
    msq_fill_report paths = {.struct_size = sizeof paths};
    check(msq_fill_info(fill, &paths));
    length += paths.length;
    travel += paths.travel;
    count += paths.path_count;
    if (layer == layers / 2 && argc > 3) draw(argv[3], &paths, line_width);
    msq_fill_release(fill);
  }
  printf(
      "%d layers: density %.4f of %.4f, %.1f paths and %.2f m of lines per layer, travel %.1f %%\n",
      layers, length * line_width / (layers * area), density, (double)count / layers,
      1e-3 * length / layers, 100 * travel / length);
  msq_structure_release(infill.pattern);
  msq_context_release(infill.context);
  return 0;
}
