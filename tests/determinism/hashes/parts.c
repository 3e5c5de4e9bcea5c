/* SPDX-License-Identifier: Apache-2.0 */
#include "parts.h"

#include <stdio.h>
#include <stdlib.h>

void must(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "%s: %s\n", msq_status_name(status), msq_error_message());
  exit(2);
}

void throw_away(Kit* kit) {
  for (int i = 0; i < kit->field_count; ++i) msq_field_release(kit->fields[i]);
  for (int i = 0; i < kit->structure_count; ++i) msq_structure_release(kit->structures[i]);
  for (int i = 0; i < kit->shape_count; ++i) msq_shape_release(kit->shapes[i]);
  for (int i = 0; i < kit->model_count; ++i) msq_model_release(kit->models[i]);
}

static const double origin[3] = {0, 0, 0}, far_corner[3] = {20, 20, 20}, centre[3] = {10, 10, 10};

/* ---- Shapes ---- */

static msq_shape* keep_shape(Kit* kit, msq_shape* shape) {
  return kit->shapes[kit->shape_count++] = shape;
}

msq_shape* box(Kit* kit) {
  msq_shape* shape;
  must(msq_shape_from_box(kit->context, origin, far_corner, &shape));
  return keep_shape(kit, shape);
}

msq_shape* sphere(Kit* kit, double radius) {
  msq_shape* shape;
  must(msq_shape_from_sphere(kit->context, centre, radius, &shape));
  return keep_shape(kit, shape);
}

msq_shape* cylinder(Kit* kit) {
  const double from[3] = {3, 4, 1}, to[3] = {16, 15, 19};
  msq_shape* shape;
  must(msq_shape_from_cylinder(kit->context, from, to, 7, &shape));
  return keep_shape(kit, shape);
}

msq_shape* mesh(Kit* kit, int is_open) {
  static const double vertices[6][3] = {{1, 9, 10.3},  {19, 11, 9.1}, {10.2, 0.5, 9},
                                        {9, 19.5, 11}, {8, 10, 1},    {11, 9, 18.7}};
  static const uint32_t triangles[8][3] = {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5},
                                           {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}};
  msq_mesh_def def;
  must(msq_mesh_def_init(&def, sizeof def));
  def.vertices = vertices;
  def.vertex_count = 6;
  def.triangles = &triangles[0][0];
  def.triangle_count = is_open ? 7 : 8;
  msq_shape* shape;
  must(msq_shape_from_mesh(kit->context, &def, &shape));
  return keep_shape(kit, shape);
}

/* A ball with ripples, as grey values. */
static void draw_image(uint8_t values[24][24][24]) {
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) {
        const int x = 2 * i - 23, y = 2 * j - 23, z = 2 * k - 23;
        const int grey = 255 - (x * x + y * y + z * z) / 5 + (i * j + 3 * k) % 17;
        values[k][j][i] = (uint8_t)(grey < 0 ? 0 : grey > 255 ? 255 : grey);
      }
}

static void fill_image(msq_image* image, uint8_t values[24][24][24]) {
  draw_image(values);
  image->values = values;
  image->value_type = MSQ_UINT8;
  for (int axis = 0; axis < 3; ++axis) {
    image->size[axis] = 24;
    image->grid.cell_size[axis] = 0.85;
  }
}

msq_shape* voxels(Kit* kit) {
  static uint8_t values[24][24][24];
  msq_voxels_def def;
  must(msq_voxels_def_init(&def, sizeof def));
  fill_image(&def.image, values);
  def.threshold = 170;
  msq_shape* shape;
  must(msq_shape_from_voxels(kit->context, &def, &shape));
  return keep_shape(kit, shape);
}

msq_shape* placed(Kit* kit, const msq_shape* original) {
  const double matrix[12] = {0.8, -0.6, 0, 8, 0.6, 0.8, 0, -4, 0, 0, 1, 0.3};
  msq_shape* shape;
  must(msq_shape_placed(original, matrix, &shape));
  return keep_shape(kit, shape);
}

msq_shape* difference(Kit* kit, const msq_shape* a, const msq_shape* b) {
  const msq_shape* both[2] = {a, b};
  msq_shape* shape;
  must(msq_shape_boolean(MSQ_BOOLEAN_DIFFERENCE, both, 2, &shape));
  return keep_shape(kit, shape);
}

/* ---- Fields and parameters ---- */

msq_param number(double value) {
  const msq_param parameter = {value, NULL};
  return parameter;
}

static msq_param keep_field(Kit* kit, msq_field* field) {
  kit->fields[kit->field_count++] = field;
  const msq_param parameter = {0, field};
  return parameter;
}

msq_param gradient(Kit* kit, double from, double to) {
  const double low[3] = {2, 3, 1}, high[3] = {18, 15, 20};
  msq_field* field;
  must(msq_field_gradient(kit->context, low, from, high, to, &field));
  return keep_field(kit, field);
}

msq_param radial(Kit* kit, double from, double to) {
  msq_radial_field_def def;
  must(msq_radial_field_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) def.center[axis] = 9 + axis;
  def.from_value = from;
  def.to_radius = 14;
  def.to_value = to;
  msq_field* field;
  must(msq_field_radial(kit->context, &def, &field));
  return keep_field(kit, field);
}

msq_param expression(Kit* kit, const char* text, double low, double high) {
  msq_expression_field_def def;
  must(msq_expression_field_def_init(&def, sizeof def));
  def.expression = text;
  def.low = low;
  def.high = high;
  msq_field* field;
  must(msq_field_expression(kit->context, &def, &field));
  return keep_field(kit, field);
}

msq_param sampled(Kit* kit, double low, double high) {
  static uint8_t values[24][24][24];
  msq_grid_field_def def;
  must(msq_grid_field_def_init(&def, sizeof def));
  fill_image(&def.image, values);
  msq_field* image;
  must(msq_field_grid(kit->context, &def, &image));
  (void)keep_field(kit, image);
  const double curve[4] = {0, low, 255, high};
  msq_field* field;
  must(msq_field_map(kit->context, image, curve, 2, &field));
  return keep_field(kit, field);
}

msq_param depth(Kit* kit, const msq_shape* shape, double outside, double deep) {
  const double curve[4] = {-4, deep, 0, outside};
  msq_shape_distance_field_def def;
  must(msq_shape_distance_field_def_init(&def, sizeof def));
  def.shape = shape;
  def.curve = curve;
  def.curve_count = 2;
  msq_field* field;
  must(msq_field_shape_distance(kit->context, &def, &field, NULL));
  return keep_field(kit, field);
}

/* ---- Structures ---- */

void set_cells(msq_neighbourhood* grid, double x, double y, double z) {
  grid->cell_size[0] = x;
  grid->cell_size[1] = y;
  grid->cell_size[2] = z;
}

void turn(msq_neighbourhood* grid) {
  static const double rotation[9] = {2. / 3,  -1. / 3, 2. / 3, 2. / 3, 2. / 3,
                                     -1. / 3, -1. / 3, 2. / 3, 2. / 3};
  for (int i = 0; i < 9; ++i) grid->rotation[i] = rotation[i];
  grid->origin[0] = 1.3;
  grid->origin[1] = -0.7;
}

static const msq_structure* keep_structure(Kit* kit, msq_structure* structure) {
  return kit->structures[kit->structure_count++] = structure;
}

msq_lattice_def lattice_def(int32_t unit_cell, double cell, msq_param radius) {
  msq_lattice_def def;
  must(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  set_cells(&def.grid, cell, cell, cell);
  def.radius = radius;
  return def;
}

const msq_structure* lattice(Kit* kit, const msq_lattice_def* def) {
  msq_structure* structure;
  must(msq_structure_lattice(kit->context, def, &structure));
  return keep_structure(kit, structure);
}

msq_foam_def foam_def(double cell, msq_param radius) {
  msq_foam_def def;
  must(msq_foam_def_init(&def, sizeof def));
  set_cells(&def.grid, cell, cell, cell);
  def.radius = radius;
  def.seed = 7;
  return def;
}

const msq_structure* foam(Kit* kit, const msq_foam_def* def) {
  msq_structure* structure;
  must(msq_structure_foam(kit->context, def, &structure));
  return keep_structure(kit, structure);
}

msq_functional_def functional_def(int32_t function, int32_t kind, double cell) {
  msq_functional_def def;
  must(msq_functional_def_init(&def, sizeof def));
  def.function = function;
  def.kind = kind;
  set_cells(&def.grid, cell, cell, cell);
  return def;
}

const msq_structure* functional(Kit* kit, const msq_functional_def* def) {
  msq_structure* structure;
  must(msq_structure_functional(kit->context, def, &structure));
  return keep_structure(kit, structure);
}

const msq_structure* waves(Kit* kit) {
  msq_waves_def def;
  must(msq_waves_def_init(&def, sizeof def));
  def.seed = 9;
  def.count = 60;
  def.cone_angles[0] = 70;
  def.cone_angles[2] = 25;
  set_cells(&def.grid, 5, 4, 7);
  turn(&def.grid);
  def.level = gradient(kit, -0.6, 0.4);
  msq_structure* structure;
  must(msq_structure_waves(kit->context, &def, &structure));
  return keep_structure(kit, structure);
}

const msq_structure* plate_lattice(Kit* kit) {
  msq_plate_lattice_def def;
  must(msq_plate_lattice_def_init(&def, sizeof def));
  def.plate_cell = MSQ_PLATE_CELL_KELVIN;
  set_cells(&def.grid, 5, 4, 7);
  def.thickness = gradient(kit, 0.1, 0.6);
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.radius = number(0.3);
  msq_structure* structure;
  must(msq_structure_plate_lattice(kit->context, &def, &structure));
  return keep_structure(kit, structure);
}

const msq_structure* beams(Kit* kit) {
  enum { node_total = 40, beam_total = 60 };
  static double at[node_total][3], radii[beam_total][2];
  static uint32_t ends[beam_total][2];
  static uint8_t caps[beam_total][2];
  for (int i = 0; i < node_total; ++i)
    for (int axis = 0; axis < 3; ++axis) at[i][axis] = (i * (7 + 6 * axis) + 3 * axis) % 41 * 0.5;
  for (int i = 0; i < beam_total; ++i)
    for (int end = 0; end < 2; ++end) {
      ends[i][end] = (uint32_t)((i + end * (1 + i % 5)) % node_total);
      radii[i][end] = 0.2 + (i * 3 + end * 5) % 7 * 0.13;
      caps[i][end] = (uint8_t)((i + end) % 3);
    }
  msq_beams_def def;
  must(msq_beams_def_init(&def, sizeof def));
  def.nodes = at;
  def.node_count = node_total;
  def.beams = &ends[0][0];
  def.beam_count = beam_total;
  def.radii = radii;
  def.caps = &caps[0][0];
  msq_structure* structure;
  must(msq_structure_beams(kit->context, &def, &structure, NULL));
  return keep_structure(kit, structure);
}

const msq_structure* joined(Kit* kit, int32_t operation, const msq_structure* a,
                            const msq_structure* b) {
  const msq_structure* both[2] = {a, b};
  msq_structure* structure;
  must(msq_structure_boolean(operation, both, 2, &structure));
  return keep_structure(kit, structure);
}

const msq_structure* blended(Kit* kit, const msq_structure* a, const msq_structure* b,
                             msq_param fraction) {
  msq_structure* structure;
  must(msq_structure_blend(a, b, &fraction, &structure));
  return keep_structure(kit, structure);
}

const msq_structure* filleted(Kit* kit, int32_t operation, const msq_structure* a,
                              const msq_structure* b, msq_param radius) {
  msq_structure* structure;
  must(msq_structure_smooth_boolean(operation, a, b, &radius, &structure));
  return keep_structure(kit, structure);
}
