/* SPDX-License-Identifier: Apache-2.0
 * A unit cell of your own: nodes in the unit cube, struts between them, and a factor of the radius
 * for each strut. Prints what msq says of it and a layer of a block. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "unit_cell: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* A cube with a cross in each of the two faces that are normal to z. The struts along z are
 * thicker. Opposite faces have the same nodes, so the struts of neighbouring cells join. */
static const double nodes[10][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0},
                                    {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5, 0.5, 1}};
static const uint32_t struts[12][2] = {{0, 4}, {1, 4}, {2, 4}, {3, 4}, {5, 9}, {6, 9},
                                       {7, 9}, {8, 9}, {0, 5}, {1, 6}, {2, 7}, {3, 8}};
static const double factors[12] = {1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2};

int main(void) {
  /* Ask first: struts whose ends meet nothing in the next cell are no error, but rarely meant. */
  msq_unit_cell_def cell;
  check(msq_unit_cell_def_init(&cell, sizeof cell));
  cell.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  cell.nodes = &nodes[0][0];
  cell.node_count = 10;
  cell.struts = &struts[0][0];
  cell.strut_count = 12;
  cell.strut_factors = factors;
  msq_unit_cell_report report = {.struct_size = sizeof report};
  check(msq_unit_cell_info(&cell, &report, NULL, 0));
  printf("%s; %llu struts per cell of the tiling, %.3f cells long together\n",
         report.is_periodic ? "all nodes meet" : "some nodes do not meet",
         (unsigned long long)report.tiled_strut_count, report.tiled_length);

  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {-1, -1, -1}, max[3] = {31, 16, 16};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));
  msq_lattice_def lattice_def;
  check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.cells = &cell; /* a library of one cell; a field could choose among several */
  lattice_def.cell_count = 1;
  for (int axis = 0; axis < 3; ++axis) lattice_def.grid.cell_size[axis] = 7.5;
  lattice_def.radius.value = 0.6;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &lattice_def, &lattice));

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = lattice}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_slicer_def plan; /* one layer, through the crosses at z = 7.5 */
  const double z = 7.5;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.output = MSQ_LAYER_BYTES;
  plan.resolution[0] = 96;
  plan.resolution[1] = 25;
  plan.layer_z = &z;
  plan.layer_z_count = 1;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  static uint8_t pixels[25][96];
  check(msq_slice_layer(slicer, 0, &pixels[0][0], sizeof pixels, NULL));
  int solid = 0;
  for (int y = 25; y-- > 0; putchar('\n'))
    for (int x = 0; x < 96; ++x) {
      solid += pixels[y][x] != 0;
      putchar(pixels[y][x] ? '#' : '.');
    }

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(lattice);
  msq_shape_release(box);
  msq_context_release(context);
  return !(report.is_periodic && report.tiled_strut_count == 5 && solid > 300 && solid < 1800);
}
