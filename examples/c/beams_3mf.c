/* SPDX-License-Identifier: Apache-2.0
 * The struts of a Voronoi foam in a box, as a beam lattice in a 3MF file. Slicers and programs of
 * finite elements read it.
 *
 * usage: beams_3mf [beams.3mf] */
#include <msq.h>
#include <msq_io.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "beams_3mf: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_structure* make_foam(msq_context* context) {
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 4;
  def.radius.value = 0.3;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  return foam;
}

int main(int argc, char** argv) {
  const char* path = argc > 1 ? argv[1] : "beams.3mf";
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_structure* foam = make_foam(context);
  const double min[3] = {0, 0, 0}, max[3] = {40, 30, 20};
  msq_shape* part;
  check(msq_shape_from_box(context, min, max, &part));

  msq_struts_def struts;
  check(msq_struts_def_init(&struts, sizeof struts));
  struts.selection = MSQ_STRUTS_NEAR;
  for (int axis = 0; axis < 3; ++axis) {
    struts.min[axis] = min[axis];
    struts.max[axis] = max[axis];
  }
  struts.shape = part; /* beams end where they leave the part */
  msq_strut_graph* graph;
  check(msq_structure_strut_graph(context, foam, &struts, &graph, NULL));

  msq_io_beams_def def;
  check(msq_io_beams_def_init(&def, sizeof def)); /* beams alone, without a mesh */
  const msq_status status = msq_io_beams_save(graph, &def, path, 1);
  if (status == MSQ_OK) {
    msq_strut_graph_report report = {.struct_size = sizeof report};
    check(msq_strut_graph_info(graph, &report));
    printf("%llu beams between %llu nodes in %s\n", (unsigned long long)report.strut_count,
           (unsigned long long)report.node_count, path);
  } else {
    fprintf(stderr, "beams_3mf: %s: %s\n", msq_status_name(status), msq_io_error_message());
  }
  msq_strut_graph_release(graph);
  msq_shape_release(part);
  msq_structure_release(foam);
  msq_context_release(context);
  return status != MSQ_OK;
}
