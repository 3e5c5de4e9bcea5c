/* SPDX-License-Identifier: Apache-2.0
 * msq_plate_lattice_def_init, msq_structure_plate_lattice. */
#include "definitions.h"

static msq_context* context;

static msq_plate_lattice_def plates_def(int32_t plate_cell, double thickness) {
  msq_plate_lattice_def def;
  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  def.plate_cell = plate_cell;
  def.thickness.value = thickness;
  return def;
}

static msq_structure* plates_of(const msq_plate_lattice_def* def) {
  msq_structure* structure;
  assert_ok(msq_structure_plate_lattice(context, def, &structure));
  return structure;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_plate_lattice_def def;
  (void)state;
  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  assert_int_equal(def.plate_cell, MSQ_PLATE_CELL_CUBIC);
  assert_default_grid(&def.grid);
  assert_true(def.thickness.value == 0 && def.radius.value == 0);
  assert_null(def.thickness.field);
  assert_null(def.radius.field);
  assert_null(def.nodes);
  assert_null(def.faces);
  assert_null(def.face_factors);
  assert_int_equal(def.unit_cell, MSQ_UNIT_CELL_CUBIC);
  assert_null(def.struts);
  assert_null(def.strut_factors);
  assert_true(def.node_count == 0 && def.face_count == 0 && def.strut_count == 0);
}

/* The distance to the nearest plane n * size along an axis. */
static double to_plane(double x, double size) {
  const double cells = x / size;
  return fabs(cells - round(cells)) * size;
}

static void cubic_plates_are_planes_in_model_units(void** state) {
  const double sizes[3] = {0.7, 1.3, 1},
               rotation[9] = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6};
  uint64_t random = 3;
  (void)state;
  for (int with_struts = 0; with_struts < 2; ++with_struts) {
    msq_plate_lattice_def def = plates_def(MSQ_PLATE_CELL_CUBIC, 0.16);
    memcpy(def.grid.cell_size, sizes, sizeof sizes);
    memcpy(def.grid.rotation, rotation, sizeof rotation);
    def.grid.origin[1] = -7.1;
    if (with_struts) def.radius.value = 0.15; /* along the edges of the cells */
    msq_model* model = make_model(context, make_box_of(context, -3, 3), plates_of(&def), NULL);
    for (size_t i = 0; i < test_count(4000); ++i) {
      double p[3], q[3] = {0, 0, 0}, to[3];
      for (int axis = 0; axis < 3; ++axis) p[axis] = random_between(&random, -3, 3);
      for (int row = 0; row < 3; ++row)
        for (int axis = 0; axis < 3; ++axis)
          q[axis] += rotation[3 * row + axis] * (p[row] - def.grid.origin[row]);
      for (int axis = 0; axis < 3; ++axis) to[axis] = to_plane(q[axis], sizes[axis]);
      double gap = fmin(to[0], fmin(to[1], to[2])) - 0.08;
      if (with_struts)
        gap = fmin(
            gap, fmin(hypot(to[0], to[1]), fmin(hypot(to[1], to[2]), hypot(to[2], to[0]))) - 0.15);
      if (fabs(gap) > 1e-9) assert_int_equal(is_inside(model, p[0], p[1], p[2]), gap < 0);
    }
    msq_model_release(model);
  }
}

static void thickness_is_calibrated(void** state) {
  msq_plate_lattice_def def = plates_def(MSQ_PLATE_CELL_CUBIC, 0.1);
  msq_calibration_report report = {.struct_size = sizeof report};
  (void)state;
  msq_structure* structure = plates_of(&def);
  assert_ok(msq_structure_calibrate(context, structure, NULL, 1 - 0.75 * 0.75 * 0.75, NULL, NULL, 0,
                                    &report, NULL));
  assert_true(fabs(report.parameter - 0.25) < 0.01);
  msq_structure_release(structure);
  /* Radius and thickness are two parameters. */
  def.radius.value = 0.1;
  structure = plates_of(&def);
  assert_int_equal(
      msq_structure_calibrate(context, structure, NULL, 0.5, NULL, NULL, 0, &report, NULL),
      MSQ_E_UNSUPPORTED);
  msq_structure_release(structure);
}

/* What a named cell, or a lattice without struts, does not read may hold anything. */
static void unread_members_are_ignored(void** state) {
  static const double nodes[3] = {9, 9, 9};
  static const uint32_t faces[3] = {7, 7, 7};
  msq_plate_lattice_def def = plates_def(MSQ_PLATE_CELL_FCC, 0.1);
  (void)state;
  def.nodes = nodes;
  def.node_count = 1;
  def.faces = faces;
  def.face_count = 1;
  def.unit_cell = 77;
  msq_structure_release(plates_of(&def));
}

static int make(void** state) {
  (void)state;
  context = make_context();
  return 0;
}

static int release(void** state) {
  (void)state;
  msq_context_release(context);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(cubic_plates_are_planes_in_model_units),
      cmocka_unit_test(thickness_is_calibrated),
      cmocka_unit_test(unread_members_are_ignored),
  };
  return cmocka_run_group_tests_name("msq_structure_plate_lattice", tests, make, release);
}
