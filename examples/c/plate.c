/* SPDX-License-Identifier: Apache-2.0
 * Two instances of a part on a plate, the second turned, each with a modifier volume that is filled
 * in another way: one model, so one layer of the whole plate, printed as text. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "plate: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* The part, in its own frame: a box with a hole. */
static msq_shape* make_part(msq_context* context) {
  const double min[3] = {0, 0, 0}, max[3] = {24, 16, 8};
  const double from[3] = {6, 8, -1}, to[3] = {6, 8, 9};
  msq_shape *both[2], *part;
  check(msq_shape_from_box(context, min, max, &both[0]));
  check(msq_shape_from_cylinder(context, from, to, 3, &both[1]));
  check(msq_shape_boolean(MSQ_BOOLEAN_DIFFERENCE, (const msq_shape* const*)both, 2, &part));
  for (int i = 0; i < 2; ++i) msq_shape_release(both[i]);
  return part;
}

/* The part of a modifier volume, a ball, that lies in the part. */
static msq_shape* make_modified(msq_context* context, const msq_shape* part) {
  const double center[3] = {17, 8, 4};
  msq_shape *ball, *modified;
  check(msq_shape_from_sphere(context, center, 6, &ball));
  const msq_shape* const both[2] = {part, ball};
  check(msq_shape_boolean(MSQ_BOOLEAN_INTERSECTION, both, 2, &modified));
  msq_shape_release(ball);
  return modified;
}

/* Where an instance stands on the plate. */
static msq_shape* place(const msq_shape* shape, const double matrix[12]) {
  msq_shape* placed;
  check(msq_shape_placed(shape, matrix, &placed));
  return placed;
}

/* Releases the shape. skin: as thick as walls are. */
static msq_model* fill(msq_context* context, msq_shape* shape, const msq_structure* structure,
                       double skin) {
  const msq_scale_def scales[2] = {{.shape = shape},
                                   {.structure = structure, .skin = {skin, NULL}}};
  msq_model_def def;
  msq_model* model;
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  check(msq_model_create(context, &def, &model));
  msq_shape_release(shape);
  return model;
}

/* A lattice whose cells stand in the frame of an instance; without the matrix, in the plate's. */
static msq_structure* make_lattice(msq_context* context, double cell, double radius,
                                   const double matrix[12]) {
  msq_lattice_def def;
  msq_structure* lattice;
  check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell;
  def.radius.value = radius;
  check(msq_neighbourhood_placed(&def.grid, matrix, &def.grid));
  check(msq_structure_lattice(context, &def, &lattice));
  return lattice;
}

int main(void) {
  static const double places[2][12] = {
      {1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 1, 0},
      {0.8, -0.6, 0, 40, 0.6, 0.8, 0, 1, 0, 0, 1, 0} /* turned by 36.87 degrees */
  };
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_shape *part = make_part(context), *modified = make_modified(context, part);

  msq_model* regions[4]; /* modifier volumes go before the parts that they lie in */
  for (int i = 0; i < 2; ++i) {
    msq_structure* fine = make_lattice(context, 3, 0.9, places[i]);
    msq_structure* coarse = make_lattice(context, 8, 1, places[i]);
    regions[i] = fill(context, place(modified, places[i]), fine, 0);
    regions[2 + i] = fill(context, place(part, places[i]), coarse, 0.8);
    msq_structure_release(fine);
    msq_structure_release(coarse);
  }
  msq_model* plate;
  check(msq_model_regions(context, (const msq_model* const*)regions, 4, &plate));

  msq_slicer_def def; /* characters are twice as high as wide */
  check(msq_slicer_def_init(&def, sizeof def));
  def.output = MSQ_LAYER_BYTES;
  def.pitch[0] = 0.5;
  def.pitch[1] = 1;
  def.layer_height = 0.5;
  msq_slicer* slicer;
  check(msq_slicer_create(plate, &def, &slicer));
  msq_slicer_report plan = {.struct_size = sizeof plan};
  check(msq_slicer_info(slicer, &plan));
  uint8_t* pixels = malloc(plan.layer_bytes);
  if (!pixels) return 1;
  check(msq_slice_layer(slicer, 12, pixels, plan.layer_bytes, NULL));
  for (uint32_t y = plan.height; y-- > 0; putchar('\n'))
    for (uint32_t x = 0; x < plan.width; ++x) {
      /* Which region a pixel is in, by its centre. */
      const double point[3] = {plan.origin[0] + x * plan.pitch[0],
                               plan.origin[1] + y * plan.pitch[1], 6.25};
      int32_t region;
      check(msq_point_region(plate, point, &region));
      putchar(pixels[y * plan.stride + x] ? "o*##"[region] : region < 0 ? ' ' : '.');
    }

  free(pixels);
  msq_slicer_release(slicer);
  msq_model_release(plate);
  for (int i = 0; i < 4; ++i) msq_model_release(regions[i]);
  msq_shape_release(modified);
  msq_shape_release(part);
  msq_context_release(context);
  return 0;
}
