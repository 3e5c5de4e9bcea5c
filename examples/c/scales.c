/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws one layer of a part at each length scale: an octet lattice with gyroids in its struts, and
 * the same with a finer lattice between the two. Try: scales examples/parts/bracket.stl scales.png
 */
#include <msq.h>
#include <msq_io.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 400, MOST = 4, GAP = 8, WIDTH = MOST * (SIDE + GAP), HEIGHT = 2 * (SIDE + GAP) };

static uint8_t pixels[HEIGHT][WIDTH];

#define TRY(call)                          \
  do {                                     \
    const msq_status status_ = (call);     \
    if (status_ != MSQ_OK) return status_; \
  } while (0)

static msq_status make_lattice(msq_context* context, int32_t unit_cell, double cell, double radius,
                               msq_structure** lattice) {
  msq_lattice_def def;
  TRY(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell;
  def.radius.value = radius;
  return msq_structure_lattice(context, &def, lattice);
}

static msq_status make_gyroid(msq_context* context, double cell, msq_structure** gyroid) {
  msq_functional_def def;
  TRY(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_GYROID;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell;
  return msq_structure_functional(context, &def, gyroid);
}

/* One panel for each scale: those from it on are resolved. */
static msq_status draw(const msq_model* model, uint32_t scales, int row) {
  static uint8_t layer[SIDE * SIDE];
  for (uint32_t scale = 0; scale < scales; ++scale) {
    msq_slicer_def def;
    msq_slicer* slicer;
    TRY(msq_slicer_def_init(&def, sizeof def));
    TRY(msq_model_scale_length(model, scale, &def.length_scale)); /* that of the part is infinite */
    def.output = MSQ_LAYER_BYTES;
    def.resolution[0] = def.resolution[1] = SIDE;
    def.has_region = 1;
    TRY(msq_model_bounds(model, def.region_min, def.region_max));
    const double z = def.region_min[2] + 12.5; /* 40 mm about the middle of the part */
    for (int axis = 0; axis < 2; ++axis) {
      const double middle = 0.5 * (def.region_min[axis] + def.region_max[axis]);
      def.region_min[axis] = middle - 20;
      def.region_max[axis] = middle + 20;
    }
    def.layer_z = &z;
    def.layer_z_count = 1;
    TRY(msq_slicer_create(model, &def, &slicer));
    const msq_status status = msq_slice_layer(slicer, 0, layer, sizeof layer, NULL);
    msq_slicer_release(slicer);
    TRY(status);
    for (int y = 0; y < SIDE; ++y)
      for (int x = 0; x < SIDE; ++x)
        pixels[row * (SIDE + GAP) + SIDE - 1 - y][scale * (SIDE + GAP) + (uint32_t)x] =
            (uint8_t)(255 - layer[y * SIDE + x]);
  }
  return MSQ_OK;
}

static msq_status run(msq_context* context, const char* file) {
  msq_shape* part;
  msq_structure *octet, *bcc, *coarse_gyroid, *gyroid;
  msq_model *three, *four;
  msq_model_def def;
  TRY(msq_shape_from_file(context, file, NULL, &part, NULL));
  TRY(make_lattice(context, MSQ_UNIT_CELL_OCTET, 12, 1.8, &octet));
  TRY(make_lattice(context, MSQ_UNIT_CELL_BCC, 3, 0.6, &bcc));
  TRY(make_gyroid(context, 1.2, &coarse_gyroid));
  TRY(make_gyroid(context, 0.8, &gyroid));
  /* Coarsest first: each fills the solid of the one before. The part keeps a skin of 0.6 mm. */
  const msq_scale_def nested[4] = {{.shape = part},
                                   {.structure = octet, .skin = {0.6, NULL}},
                                   {.structure = bcc, .skin = {0.6, NULL}},
                                   {.structure = gyroid, .skin = {0.6, NULL}}};
  const msq_scale_def filled[3] = {nested[0], nested[1], {.structure = coarse_gyroid}};
  TRY(msq_model_def_init(&def, sizeof def));
  def.scale_size = sizeof nested[0];
  def.scales = filled;
  def.scale_count = 3;
  TRY(msq_model_create(context, &def, &three));
  def.scales = nested;
  def.scale_count = 4;
  TRY(msq_model_create(context, &def, &four));
  TRY(draw(three, 3, 0));
  TRY(draw(four, 4, 1));
  msq_model_release(four);
  msq_model_release(three);
  msq_structure_release(gyroid);
  msq_structure_release(coarse_gyroid);
  msq_structure_release(bcc);
  msq_structure_release(octet);
  msq_shape_release(part);
  return MSQ_OK;
}

int main(int argc, char** argv) {
  if (argc != 3) {
    fputs("usage: scales PART PICTURE.png\n", stderr);
    return 2;
  }
  memset(pixels, 255, sizeof pixels);
  msq_context* context = NULL;
  msq_status status = msq_context_create(NULL, &context);
  if (status == MSQ_OK) status = run(context, argv[1]);
  if (status != MSQ_OK) fprintf(stderr, "scales: %s\n", msq_error_message());
  msq_context_release(context);
  if (status != MSQ_OK) return 1;
  if (msq_io_picture_save(argv[2], WIDTH, HEIGHT, 1, pixels[0], 0, 1) == MSQ_OK) return 0;
  fprintf(stderr, "scales: %s\n", msq_io_error_message());
  return 1;
}
