/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_strut_graph and msq_strut_graph_info. */
#include "struts.h"

static msq_strut_graph_report contents_of(const msq_strut_graph* graph) {
  msq_strut_graph_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_strut_graph_info(graph, &report));
  return report;
}

static void graphs_number_nodes(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.125);
  const msq_struts_def def = struts_def(0, 4);
  const uint64_t before = memory_of(context).bytes;
  msq_strut_graph* graph;
  msq_strut_graph_report known;
  uint64_t next = 0;
  (void)state;
  assert_ok(msq_structure_strut_graph(context, lattice, &def, &graph, NULL));
  msq_strut_graph_retain(graph);
  msq_strut_graph_release(graph);
  known = contents_of(graph);
  assert_int_equal(known.strut_count, 192);
  assert_int_equal(known.node_count, 64 + 3 * 16);
  for (uint64_t i = 0; i < known.strut_count; ++i) {
    double length = 0;
    for (int end = 0; end < 2; ++end) {
      const uint32_t node = known.struts[2 * i + end];
      assert_true(node <= next); /* in the order in which they first occur */
      if (node == next) ++next;
      assert_true(known.radii[2 * i + end] == 0.125);
      assert_int_equal(known.caps[2 * i + end] + known.cuts[2 * i + end], 0);
    }
    for (int axis = 0; axis < 3; ++axis) {
      length += fabs(known.nodes[3 * known.struts[2 * i] + axis] -
                     known.nodes[3 * known.struts[2 * i + 1] + axis]);
      assert_true(known.cells[3 * i + axis] >= 0 && known.cells[3 * i + axis] < 4);
    }
    assert_true(length == 1);
  }
  assert_int_equal(next, known.node_count);
  assert_int_equal(memory_of(context).bytes - before,
                   56 * known.strut_count + 40 * known.node_count);
  msq_strut_graph_release(graph);
  assert_int_equal(memory_of(context).bytes, before);
  msq_structure_release(lattice);
  msq_context_release(context);
}

static void ends_at_one_place_are_joined(void** state) {
  msq_context* context = make_context();
  msq_structure* truss = make_truss(context);
  const msq_struts_def def = struts_def(-1, 3), none = struts_def(50, 60);
  msq_strut_graph* graph;
  msq_strut_graph_report known;
  (void)state;
  assert_ok(msq_structure_strut_graph(context, truss, &def, &graph, NULL));
  known = contents_of(graph);
  assert_int_equal(known.strut_count, 3);
  assert_int_equal(known.node_count, 3); /* two nodes of the definition are at one place */
  msq_strut_graph_release(graph);
  assert_ok(msq_structure_strut_graph(context, truss, &none, &graph, NULL));
  known = contents_of(graph);
  assert_int_equal(known.strut_count + known.node_count, 0);
  msq_strut_graph_release(graph);
  msq_structure_release(truss);
  msq_context_release(context);
}

static void memory_is_limited(void** state) {
  msq_context* context = make_context_of(1, 1 << 16, 1 << 20);
  msq_structure* lattice = make_lattice(context);
  const msq_struts_def large = struts_def(0, 40);
  const uint64_t before = memory_of(context).bytes;
  (void)state;
  assert_makes_nothing(msq_strut_graph,
                       msq_structure_strut_graph(context, lattice, &large, &made, NULL),
                       MSQ_E_LIMIT, "the graph of struts");
  assert_int_equal(memory_of(context).bytes, before);
  msq_strut_graph_retain(NULL);
  msq_strut_graph_release(NULL);
  msq_structure_release(lattice);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(graphs_number_nodes),
      cmocka_unit_test(ends_at_one_place_are_joined),
      cmocka_unit_test(memory_is_limited),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
