/* SPDX-License-Identifier: Apache-2.0
 * A beam model of a lattice in a ball, for programs of finite elements: nodes, beams between them
 * and their radii.
 *
 * usage: struts_graph [obj|csv] */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "struts_graph: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_structure* make_lattice(msq_context* context) {
  msq_lattice_def def;
  check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_OCTET;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 5;
  def.radius.value = 0.3;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &def, &lattice));
  return lattice;
}

/* Vertices, and a line for each beam: most programs that show meshes show them. */
static void print_obj(const msq_strut_graph_report* graph) {
  for (uint64_t i = 0; i < graph->node_count; ++i)
    printf("v %.9g %.9g %.9g\n", graph->nodes[3 * i], graph->nodes[3 * i + 1],
           graph->nodes[3 * i + 2]);
  for (uint64_t i = 0; i < graph->strut_count; ++i)
    printf("l %u %u\n", graph->struts[2 * i] + 1, graph->struts[2 * i + 1] + 1);
}

/* One table of nodes and one of beams. Supports go where a beam is cut. */
static void print_csv(const msq_strut_graph_report* graph) {
  printf("node,x,y,z\n");
  for (uint64_t i = 0; i < graph->node_count; ++i)
    printf("%llu,%.17g,%.17g,%.17g\n", (unsigned long long)i, graph->nodes[3 * i],
           graph->nodes[3 * i + 1], graph->nodes[3 * i + 2]);
  printf("beam,first,second,first_radius,second_radius,first_is_cut,second_is_cut\n");
  for (uint64_t i = 0; i < graph->strut_count; ++i)
    printf("%llu,%u,%u,%.9g,%.9g,%d,%d\n", (unsigned long long)i, graph->struts[2 * i],
           graph->struts[2 * i + 1], graph->radii[2 * i], graph->radii[2 * i + 1],
           graph->cuts[2 * i], graph->cuts[2 * i + 1]);
}

int main(int argc, char** argv) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_structure* lattice = make_lattice(context);
  const double centre[3] = {0, 0, 0};
  msq_shape* ball;
  check(msq_shape_from_sphere(context, centre, 10, &ball));

  msq_struts_def def;
  check(msq_struts_def_init(&def, sizeof def));
  def.selection = MSQ_STRUTS_NEAR;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = -10;
    def.max[axis] = 10;
  }
  def.shape = ball;
  msq_strut_graph* graph;
  check(msq_structure_strut_graph(context, lattice, &def, &graph, NULL));
  msq_strut_graph_report report = {.struct_size = sizeof report};
  check(msq_strut_graph_info(graph, &report));

  if (argc > 1 && strcmp(argv[1], "csv") == 0)
    print_csv(&report);
  else
    print_obj(&report);
  const int is_empty = report.strut_count == 0;
  msq_strut_graph_release(graph);
  msq_shape_release(ball);
  msq_structure_release(lattice);
  msq_context_release(context);
  return is_empty;
}
