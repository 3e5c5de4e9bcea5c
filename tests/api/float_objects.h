/* SPDX-License-Identifier: Apache-2.0
 * One object of each kind, for tests of the floating-point environment: those that the host defines
 * say whether their callbacks are in the host's. */
#ifndef FLOAT_OBJECTS_H
#define FLOAT_OBJECTS_H

#include "float_states.h"

/* ---- callbacks: no arithmetic, since it may trap
 * ------------------------------------------------- */

/* What they return. */
static int callback_code;

static inline int32_t host_values(void* user, const double* points, uint64_t count,
                                  double* values) {
  (void)user;
  check_state();
  for (uint64_t i = 0; i < count; ++i) values[i] = points[3 * i] > 1.3 ? 0.2 : 0.15;
  return callback_code;
}

static inline int32_t host_range(void* user, const double min[3], const double max[3], double* low,
                                 double* high) {
  (void)user, (void)min, (void)max;
  check_state();
  *low = 0.15;
  *high = 0.2;
  return callback_code;
}

static inline int32_t host_inside(void* user, const double* points, uint64_t count,
                                  uint8_t* inside) {
  (void)user;
  check_state();
  for (uint64_t i = 0; i < count; ++i) inside[i] = points[3 * i] < points[3 * i + 1];
  return callback_code;
}

static inline int32_t host_bound(void* user, const double* points, uint64_t count, double* bounds) {
  (void)user, (void)points;
  check_state();
  for (uint64_t i = 0; i < count; ++i) bounds[i] = 0;
  return callback_code;
}

static inline int32_t positions_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  check_state();
  for (uint64_t i = 0; i < points->count; ++i)
    inside[i] = points->positions[3 * i] < 0.4 || points->positions[3 * i + 1] < 0.3;
  return callback_code;
}

static inline int32_t build_cell(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  (void)user;
  check_state();
  *data = malloc(1);
  *(char*)*data = (char)(cell[0] & 1);
  *bytes = 1;
  return callback_code;
}

static inline int32_t evaluate_cell(void* user, const void* data, const msq_host_points* points,
                                    uint8_t* inside) {
  if (*(const char*)data) return positions_inside(user, points, inside);
  check_state();
  for (uint64_t i = 0; i < points->count; ++i) inside[i] = points->positions[3 * i + 2] < 0.5;
  return callback_code;
}

static inline void free_cell(void* user, void* data) {
  (void)user;
  check_state();
  free(data);
}

static inline int32_t cell_box(void* user, const double min[3], const double max[3],
                               int32_t* answer) {
  (void)user, (void)min, (void)max;
  check_state();
  *answer = MSQ_BOX_MIXED;
  return callback_code;
}

static inline int32_t positions_bound(void* user, const msq_host_points* points, double* bounds) {
  (void)user;
  check_state();
  for (uint64_t i = 0; i < points->count; ++i) bounds[i] = 0;
  return callback_code;
}

/* 1 below 2, else -1; no number is computed. */
static inline int32_t host_function(void* user, const double* angles, uint64_t count,
                                    double* values) {
  (void)user;
  check_state();
  for (uint64_t i = 0; i < count; ++i) values[i] = angles[3 * i] < 2 ? 1 : -1;
  return callback_code;
}

static inline void host_release(void* user) {
  (void)user;
  check_state();
}

static inline int32_t take_layer(void* user, const msq_layer* layer) {
  (void)user;
  check_state();
  note(layer->data, layer->stride * layer->height);
  return callback_code;
}

static inline int32_t take_pass(void* user, const msq_render_pass* pass) {
  (void)user, (void)pass;
  check_state();
  return callback_code;
}

/* ---- models
 * --------------------------------------------------------------------------------------- */

enum kind {
  bcc,
  thick_to_thin,
  mixed,
  foam,
  foam_point,
  foam_method_1,
  foam_method_2,
  graded_foam,
  foam_of_field,
  gyroid,
  walls,
  expression,
  denormal,
  host_points_structure,
  host_cells,
  host_function_structure,
  nothing,
  kinds
};

static inline msq_status make_field(msq_context* context, int of, msq_field** field) {
  const double from[3] = {0, 0, 0}, to[3] = {2.3, 1.1, 1.7};
  const double curve[4] = {0.1, 0.09, 0.2, 0.17};
  msq_status status = MSQ_OK;
  if (of == 0) return msq_field_gradient(context, from, 0.1, to, 0.19, field);
  if (of == 1) {
    msq_radial_field_def def;
    msq_radial_field_def_init(&def, sizeof def);
    def.from_value = 0.19;
    def.to_value = 0.11;
    def.to_radius = 2.7;
    return msq_field_radial(context, &def, field);
  }
  if (of == 2) {
    msq_expression_field_def def;
    msq_expression_field_def_init(&def, sizeof def);
    def.expression = "0.15+0.04*sin(3*x)*cos(y-z)";
    def.low = 0.11;
    def.high = 0.19;
    return msq_field_expression(context, &def, field);
  }
  if (of == 3) {
    msq_host_field_def def;
    msq_host_field_def_init(&def, sizeof def);
    def.concurrent = 1;
    def.evaluate = host_values;
    def.range = host_range;
    def.release = host_release;
    def.low = 0.15;
    def.high = 0.2;
    return msq_field_host(context, &def, field);
  }
  if (of == 4) {
    static const float values[8] = {0.1f, 0.13f, 0.17f, 0.12f, 0.19f, 0.11f, 0.15f, 0.14f};
    msq_grid_field_def def;
    msq_grid_field_def_init(&def, sizeof def);
    def.image.values = values;
    def.image.value_type = MSQ_FLOAT32;
    for (int axis = 0; axis < 3; ++axis) {
      def.image.size[axis] = 2;
      def.image.grid.cell_size[axis] = 3;
    }
    return msq_field_grid(context, &def, field);
  }
  msq_field* inner;
  if (of == 5) {
    status = make_field(context, 0, &inner);
    if (status == MSQ_OK) status = msq_field_map(context, inner, curve, 2, field);
    if (status == MSQ_OK) msq_field_release(inner);
    return status;
  }
  msq_shape_distance_field_def def;
  msq_shape* shape;
  const double center[3] = {1.1, 1.2, 1.3}, steps[4] = {-1, 0.19, 1, 0.1};
  status = msq_shape_from_sphere(context, center, 0.7, &shape);
  msq_shape_distance_field_def_init(&def, sizeof def);
  def.shape = shape;
  def.curve = steps;
  def.curve_count = 2;
  def.step = 0.1;
  status = msq_field_shape_distance(context, &def, field, NULL);
  msq_shape_release(shape);
  return status;
}

static inline msq_status make_structure(msq_context* context, enum kind kind, msq_field* field,
                                        msq_structure** structure) {
  msq_lattice_def lattice;
  msq_foam_def cells;
  msq_functional_def function;
  msq_unit_cell_def library[2];
  double factors[24];
  msq_host_structure_def host;
  msq_host_function_def host_of_angles;
  msq_lattice_def_init(&lattice, sizeof lattice);
  lattice.grid.origin[0] = 0.07;
  lattice.radius.value = 0.13;
  msq_foam_def_init(&cells, sizeof cells);
  cells.grid.origin[1] = 0.3;
  cells.radius.value = 0.11;
  msq_functional_def_init(&function, sizeof function);
  msq_host_structure_def_init(&host, sizeof host);
  host.concurrent = 1;
  host.release = host_release;
  msq_host_function_def_init(&host_of_angles, sizeof host_of_angles);
  switch (kind) {
    case bcc:
      return msq_structure_lattice(context, &lattice, structure);
    case thick_to_thin:
      for (int i = 0; i < 24; ++i) factors[i] = i % 3 == 0 ? 1.3 : 0.7;
      lattice.unit_cell = MSQ_UNIT_CELL_OCTET;
      lattice.strut_factors = factors;
      lattice.strut_count = 24;
      lattice.radius.field = field;
      return msq_structure_lattice(context, &lattice, structure);
    case mixed:
      msq_unit_cell_def_init(&library[0], sizeof library[0]);
      msq_unit_cell_def_init(&library[1], sizeof library[1]);
      library[1].unit_cell = MSQ_UNIT_CELL_KELVIN;
      lattice.cells = library;
      lattice.cell_count = 2;
      lattice.cell_choice.value = 1;
      return msq_structure_lattice(context, &lattice, structure);
    case foam:
    case foam_point:
    case foam_method_1:
    case foam_method_2:
      cells.method = kind == foam            ? MSQ_FOAM_DIRECT
                     : kind == foam_point    ? MSQ_FOAM_POINT
                     : kind == foam_method_1 ? MSQ_FOAM_METHOD_1
                                             : MSQ_FOAM_METHOD_2;
      return msq_structure_foam(context, &cells, structure);
    case graded_foam:
      cells.density.value = 5;
      cells.radius.value = 0.05;
      return msq_structure_foam(context, &cells, structure);
    case foam_of_field:
      cells.radius.field = field;
      return msq_structure_foam(context, &cells, structure);
    case gyroid:
      function.level.field = field;
      return msq_structure_functional(context, &function, structure);
    case walls:
      function.kind = MSQ_FUNCTIONAL_SHEET;
      function.function = MSQ_FUNCTION_DIAMOND;
      function.thickness.value = 0.11;
      return msq_structure_functional(context, &function, structure);
    case expression:
    case denormal:
      function.function = MSQ_FUNCTION_EXPRESSION;
      function.expression = kind == denormal ? "1e-310*(sin(x)+0.3*cos(y)-0.1*z)"
                                             : "sin(x)*exp(cos(y))-sqrt(z)*0.3+x^1.5*0.01";
      return msq_structure_functional(context, &function, structure);
    case host_points_structure:
      host.inside = positions_inside;
      host.box = cell_box;
      host.distance = positions_bound;
      return msq_structure_host(context, &host, structure);
    case host_cells:
      host.build_cell = build_cell;
      host.evaluate_cell = evaluate_cell;
      host.free_cell = free_cell;
      return msq_structure_host(context, &host, structure);
    case host_function_structure:
      host_of_angles.evaluate = host_function;
      host_of_angles.concurrent = 1;
      host_of_angles.release = host_release;
      return msq_structure_host_function(context, &host_of_angles, structure);
    default:
      return MSQ_E_ARGUMENT;
  }
}

static inline msq_status make_shape(msq_context* context, int of, msq_shape** shape) {
  static const double box_min[3] = {-0.1, 0, 0.05}, box_max[3] = {2.03, 1.9, 2.1};
  static const double center[3] = {1, 1.1, 0.9}, top[3] = {1.2, 1, 2.3};
  static double corners[8][3];
  static unsigned char voxels[64];
  if (of == 0) return msq_shape_from_box(context, box_min, box_max, shape);
  if (of == 1) return msq_shape_from_sphere(context, center, 1.07, shape);
  if (of == 2) return msq_shape_from_cylinder(context, center, top, 0.83, shape);
  if (of == 3) {
    msq_mesh_def def;
    for (int i = 0; i < 8; ++i)
      for (int axis = 0; axis < 3; ++axis) corners[i][axis] = (i >> axis & 1) ? 2 : 0;
    corners[7][0] = 1.7;
    corners[0][2] = 0.31;
    msq_mesh_def_init(&def, sizeof def);
    def.vertices = corners;
    def.vertex_count = 8;
    def.triangles = cube_triangles()[0];
    def.triangle_count = 12;
    return msq_shape_from_mesh(context, &def, shape);
  }
  if (of == 4) {
    msq_voxels_def def;
    msq_voxels_def_init(&def, sizeof def);
    for (int i = 0; i < 64; ++i) voxels[i] = (unsigned char)(i * 37 % 101);
    def.image.values = voxels;
    def.image.value_type = MSQ_UINT8;
    for (int axis = 0; axis < 3; ++axis) {
      def.image.size[axis] = 4;
      def.image.grid.cell_size[axis] = 0.7;
    }
    def.threshold = 41.7;
    return msq_shape_from_voxels(context, &def, shape);
  }
  if (of == 5) {
    msq_host_shape_def def;
    msq_host_shape_def_init(&def, sizeof def);
    def.concurrent = 1;
    def.inside = host_inside;
    def.distance = host_bound;
    def.release = host_release;
    for (int axis = 0; axis < 3; ++axis) {
      def.min[axis] = 0;
      def.max[axis] = 2;
    }
    return msq_shape_from_host(context, &def, shape);
  }
  static const char off[] =
      "OFF\n4 4 6\n0.1 0.2 0.3\n1.7 0.123456789012345678 0\n0.3 1.9 0\n0.33333333333333333 0.4 "
      "2.1\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  msq_file_def def;
  msq_file_def_init(&def, sizeof def);
  def.format = MSQ_FORMAT_OFF;
  return msq_shape_from_memory(context, off, sizeof off - 1, &def, shape, NULL);
}

#endif
