/* SPDX-License-Identifier: Apache-2.0
 * A foam that is denser around an axis: a field of density subdivides its cells, and a field of
 * radius makes struts thinner where cells are smaller. Prints the struts by their distance from the
 * axis. */
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "density_foam: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* Seeds per cell: 64 on the z axis, 1 from 20 mm away on. */
static msq_field* make_density(msq_context* context) {
  msq_radial_field_def def;
  check(msq_radial_field_def_init(&def, sizeof def));
  def.axis[2] = 1;
  def.from_value = 64;
  def.to_radius = 20;
  def.to_value = 1;
  msq_field* density;
  check(msq_field_radial(context, &def, &density));
  return density;
}

/* Struts are about density^(-1/3) cells apart; the radius is a fixed part of that distance. */
static msq_field* make_radius(msq_context* context, const msq_field* density) {
  double curve[2 * 64];
  for (int i = 0; i < 64; ++i) {
    curve[2 * i] = i + 1;
    curve[2 * i + 1] = 0.8 / cbrt(i + 1);
  }
  msq_field* radius;
  check(msq_field_map(context, density, curve, 64, &radius));
  return radius;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_field* density = make_density(context);
  msq_field* radius = make_radius(context, density);
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 8;
  foam_def.density.field = density;
  foam_def.radius.field = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  msq_struts_def struts_def; /* those of a box of 40 x 40 x 40 mm */
  check(msq_struts_def_init(&struts_def, sizeof struts_def));
  for (int axis = 0; axis < 3; ++axis) {
    struts_def.min[axis] = -20;
    struts_def.max[axis] = 20;
  }
  msq_strut_graph* graph;
  check(msq_structure_strut_graph(context, foam, &struts_def, &graph, NULL));
  msq_strut_graph_report struts = {.struct_size = sizeof struts};
  check(msq_strut_graph_info(graph, &struts));

  enum { ring_count = 4 }; /* each 5 mm wide */
  double count[ring_count] = {0}, length[ring_count] = {0}, thickness[ring_count] = {0};
  for (uint64_t i = 0; i < struts.strut_count; ++i) {
    const double* a = struts.nodes + 3 * struts.struts[2 * i];
    const double* b = struts.nodes + 3 * struts.struts[2 * i + 1];
    const int ring = (int)(hypot(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])) / 5);
    if (ring >= ring_count) continue;
    count[ring] += 1;
    length[ring] += hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
    thickness[ring] += struts.radii[2 * i] + struts.radii[2 * i + 1];
  }
  int wrong = 0;
  printf("mm from the axis  struts per cm3  mean length  mean thickness\n");
  for (int ring = 0; ring < ring_count; ++ring) {
    const double volume = 3.14159265358979 * 25 * (2 * ring + 1) * 40 / 1000; /* cm3 */
    length[ring] /= count[ring];
    thickness[ring] /= count[ring];
    printf("    %2d to %2d        %8.1f      %6.2f mm       %6.2f mm\n", 5 * ring, 5 * ring + 5,
           count[ring] / volume, length[ring], thickness[ring]);
    wrong +=
        ring > 0 && !(length[ring] > length[ring - 1] && thickness[ring] > thickness[ring - 1]);
  }

  msq_strut_graph_release(graph);
  msq_structure_release(foam);
  msq_field_release(radius);
  msq_field_release(density);
  msq_context_release(context);
  return wrong;
}
