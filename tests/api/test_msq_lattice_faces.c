/* SPDX-License-Identifier: Apache-2.0
 * msq_lattice_faces. */
#include "definitions.h"

static const double low[3] = {0, 0, 0}, high[3] = {4, 3, 2};

/* Two unit cells: the first up to x = 2.5 at cell centres, then the second. */
static msq_structure* make_mixed(msq_context* context, int32_t first, int32_t second,
                                 const double rotation[9]) {
  const double from[3] = {2, 0, 0}, to[3] = {3, 0, 0};
  const msq_unit_cell_def cells[2] = {named_cell(first), named_cell(second)};
  msq_lattice_def def;
  msq_field* choice;
  msq_structure* lattice;
  assert_ok(msq_field_gradient(context, from, -0.01, to, 0.99, &choice));
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  def.cells = cells;
  def.cell_count = 2;
  def.cell_choice.field = choice;
  if (rotation) memcpy(def.grid.rotation, rotation, sizeof def.grid.rotation);
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  msq_field_release(choice);
  return lattice;
}

static msq_lattice_faces_report faces_of(const msq_structure* lattice) {
  msq_lattice_faces_report report;
  memset(&report, struct_pattern, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_lattice_faces(lattice, low, high, &report, NULL));
  return report;
}

static void assert_no_place(const msq_lattice_faces_report* report) {
  assert_int_equal(report->axis, -1);
  assert_int_equal(report->unmatched, 0);
  for (int axis = 0; axis < 3; ++axis) {
    assert_int_equal(report->cell[axis], 0);
    assert_true(report->point[axis] == 0);
  }
}

/* BCC's corners match the cube's; octet has nodes in the middle of its faces besides. */
static void faces_between_unlike_cells_are_counted(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_mixed(context, MSQ_UNIT_CELL_CUBIC, MSQ_UNIT_CELL_BCC, NULL);
  msq_lattice_faces_report report = faces_of(lattice);
  (void)state;
  assert_int_equal(report.cells, 24);
  assert_int_equal(report.faces, 6);
  assert_no_place(&report);
  msq_structure_release(lattice);

  lattice = make_mixed(context, MSQ_UNIT_CELL_OCTET, MSQ_UNIT_CELL_BCC, NULL);
  report = faces_of(lattice);
  assert_int_equal(report.cells, 24);
  assert_int_equal(report.faces, 6);
  assert_int_equal(report.unmatched, 6);
  assert_int_equal(report.axis, 0);
  assert_int_equal(report.types[0], 0);
  assert_int_equal(report.types[1], 1);
  const int32_t cell[3] = {2, 0, 0};
  assert_memory_equal(report.cell, cell, sizeof cell);
  assert_true(report.point[0] == 3 && report.point[1] == 0.5 && report.point[2] == 0.5);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* A quarter turn about z: what changes along x does so against the grid's y. */
static void places_are_in_the_model(void** state) {
  const double quarter[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  msq_context* context = make_context();
  msq_structure* lattice = make_mixed(context, MSQ_UNIT_CELL_OCTET, MSQ_UNIT_CELL_BCC, quarter);
  const msq_lattice_faces_report report = faces_of(lattice);
  (void)state;
  assert_int_equal(report.cells, 24);
  assert_int_equal(report.faces, 6);
  assert_int_equal(report.unmatched, 6);
  assert_int_equal(report.axis, 1);
  assert_int_equal(report.types[0], 1);
  assert_int_equal(report.types[1], 0);
  assert_near(report.point[0], 3, 1e-12);
  assert_near(report.point[1], 0.5, 1e-12);
  assert_near(report.point[2], 0.5, 1e-12);
  msq_structure_release(lattice);
  msq_context_release(context);
}

static void lattices_of_one_cell_have_none(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 1, 0.1);
  const msq_lattice_faces_report report = faces_of(lattice);
  (void)state;
  assert_int_equal(report.cells, 24);
  assert_int_equal(report.faces, 0);
  assert_no_place(&report);
  msq_structure_release(lattice);
  msq_context_release(context);
}

static void jobs_are_kept_and_heeded(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_mixed(context, MSQ_UNIT_CELL_OCTET, MSQ_UNIT_CELL_BCC, NULL);
  msq_lattice_faces_report report;
  msq_job* job;
  (void)state;
  report.struct_size = sizeof report;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_lattice_faces(lattice, low, high, &report, job));
  assert_true(progress_of(job) == 1);
  assert_ok(msq_job_cancel(job));
  report.cells = 77;
  assert_status(msq_lattice_faces(lattice, low, high, &report, job), MSQ_E_CANCELLED);
  assert_int_equal(report.cells, 77);
  msq_job_release(job);
  msq_structure_release(lattice);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faces_between_unlike_cells_are_counted),
      cmocka_unit_test(places_are_in_the_model),
      cmocka_unit_test(lattices_of_one_cell_have_none),
      cmocka_unit_test(jobs_are_kept_and_heeded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
