/* SPDX-License-Identifier: Apache-2.0
 * msq_unit_cell_def_init, msq_unit_cell_info. */
#include "definitions.h"

static msq_unit_cell_report report_of(const msq_unit_cell_def* cell) {
  msq_unit_cell_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_unit_cell_info(cell, &report, NULL, 0));
  return report;
}

/* Nodes 0 and 1 are copies along x; 2 has none along x; 3 has none along y and z; 4 is inside. */
static const double nodes[5][3] = {
    {0, 0.25, 0.5}, {1, 0.25, 0.5 + 1e-12}, {0, 0.75, 0.5}, {0.5, 1, 0}, {0.5, 0.5, 0.5}};
static const uint32_t struts[4][2] = {{0, 4}, {1, 4}, {2, 4}, {3, 4}};

static msq_unit_cell_def custom_cell(void) {
  msq_unit_cell_def cell = named_cell(MSQ_UNIT_CELL_CUSTOM);
  cell.nodes = nodes[0];
  cell.node_count = 5;
  cell.struts = struts[0];
  cell.strut_count = 4;
  return cell;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_unit_cell_def cell;
  (void)state;
  assert_ok(msq_unit_cell_def_init(&cell, sizeof cell));
  assert_int_equal(cell.unit_cell, MSQ_UNIT_CELL_BCC);
  assert_null(cell.nodes);
  assert_null(cell.struts);
  assert_null(cell.strut_factors);
}

/* Struts as the header says. */
static void named_cells_are_periodic(void** state) {
  const uint64_t counts[] = {3, 8, 24, 12, 24, 16, 32, 22};
  const double lengths[] = {3,           4 * sqrt(3), 12 * sqrt(2), 6 * sqrt(2),
                            6 * sqrt(2), 4 * sqrt(3), 8 * sqrt(3),  3 + 4 * sqrt(5)};
  (void)state;
  for (int32_t name = MSQ_UNIT_CELL_CUBIC; name <= MSQ_UNIT_CELL_REENTRANT; ++name) {
    const msq_unit_cell_def cell = named_cell(name);
    const msq_unit_cell_report report = report_of(&cell);
    assert_int_equal(report.is_periodic, 1);
    assert_int_equal(report.unmatched_count, 0);
    assert_int_equal(report.tiled_strut_count, counts[name - 1]);
    assert_near(report.tiled_length, lengths[name - 1], 1e-12);
    assert_true(report.node_count > 0 && report.strut_count >= report.tiled_strut_count);
    for (int axis = 0; axis < 3; ++axis) {
      assert_int_equal(report.low_nodes[axis], report.high_nodes[axis]);
      assert_int_equal(report.unmatched_nodes[axis], 0);
      assert_true(report.low_nodes[axis] > 0);
    }
  }
}

static void unmatched_nodes_are_counted_and_listed(void** state) {
  const msq_unit_cell_def cell = custom_cell();
  const msq_unit_cell_report report = report_of(&cell);
  uint32_t unmatched[4] = {77, 77, 77, 77};
  msq_unit_cell_report again;
  (void)state;
  assert_int_equal(report.is_periodic, 0);
  assert_int_equal(report.node_count, 5);
  assert_int_equal(report.strut_count, 4);
  assert_int_equal(report.tiled_strut_count, 4);
  assert_int_equal(report.low_nodes[0], 2);
  assert_int_equal(report.high_nodes[0], 1);
  assert_int_equal(report.unmatched_nodes[0], 1);
  assert_int_equal(report.low_nodes[1], 0);
  assert_int_equal(report.high_nodes[1], 1);
  assert_int_equal(report.unmatched_nodes[1], 1);
  assert_int_equal(report.low_nodes[2], 1);
  assert_int_equal(report.high_nodes[2], 0);
  assert_int_equal(report.unmatched_nodes[2], 1);
  assert_int_equal(report.unmatched_count, 2);
  again.struct_size = sizeof again;
  assert_ok(msq_unit_cell_info(&cell, &again, unmatched, 3));
  assert_memory_equal(&again, &report, sizeof report);
  assert_int_equal(unmatched[0], 2);
  assert_int_equal(unmatched[1], 3);
  assert_int_equal(unmatched[2], 77);
  unmatched[1] = 77;
  assert_ok(msq_unit_cell_info(&cell, &again, unmatched, 1));
  assert_int_equal(unmatched[0], 2);
  assert_int_equal(unmatched[1], 77);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(named_cells_are_periodic),
      cmocka_unit_test(unmatched_nodes_are_counted_and_listed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
