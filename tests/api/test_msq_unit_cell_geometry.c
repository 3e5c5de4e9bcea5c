/* SPDX-License-Identifier: Apache-2.0
 * msq_unit_cell_geometry. */
#include "fixtures.h"

/* The edges of the cube: as many as differ in one coordinate. */
static void named_cells_come_as_nodes_and_struts(void** state) {
  const msq_unit_cell_def cell = named_cell(MSQ_UNIT_CELL_CUBIC);
  double nodes[8][3];
  uint32_t struts[12][2];
  (void)state;
  assert_ok(msq_unit_cell_geometry(&cell, nodes[0], 8, struts[0], 12));
  for (int s = 0; s < 12; ++s) {
    double length = 0;
    assert_true(struts[s][0] < 8 && struts[s][1] < 8);
    for (int axis = 0; axis < 3; ++axis)
      length += fabs(nodes[struts[s][0]][axis] - nodes[struts[s][1]][axis]);
    assert_true(length == 1);
    for (int t = 0; t < s; ++t)
      assert_false(struts[t][0] == struts[s][0] && struts[t][1] == struts[s][1]);
  }
}

static void custom_cells_come_back(void** state) {
  const double nodes[3][3] = {{0, 0.5, 1}, {0.125, 0.25, 0.75}, {1, 1, 0}};
  const uint32_t struts[2][2] = {{2, 0}, {0, 1}};
  double got_nodes[3][3];
  uint32_t got_struts[2][2];
  msq_unit_cell_def cell = named_cell(MSQ_UNIT_CELL_CUSTOM);
  (void)state;
  cell.nodes = nodes[0];
  cell.node_count = 3;
  cell.struts = struts[0];
  cell.strut_count = 2;
  assert_ok(msq_unit_cell_geometry(&cell, got_nodes[0], 3, got_struts[0], 2));
  assert_memory_equal(got_nodes, nodes, sizeof nodes);
  assert_memory_equal(got_struts, struts, sizeof struts);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(named_cells_come_as_nodes_and_struts),
      cmocka_unit_test(custom_cells_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
