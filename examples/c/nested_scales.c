/* SPDX-License-Identifier: Apache-2.0
 * Structures within structures: gyroids fill the struts of an octet lattice, which fills a block.
 * A length scale says how fine a query looks: scales whose cells are smaller count as solid. */
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "nested_scales: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {0, 0, 0}, max[3] = {32, 32, 32};
  msq_shape* block;
  check(msq_shape_from_box(context, min, max, &block));

  msq_lattice_def octet_def;
  check(msq_lattice_def_init(&octet_def, sizeof octet_def));
  octet_def.unit_cell = MSQ_UNIT_CELL_OCTET;
  for (int axis = 0; axis < 3; ++axis) octet_def.grid.cell_size[axis] = 16;
  octet_def.radius.value = 2;
  msq_structure* octet;
  check(msq_structure_lattice(context, &octet_def, &octet));

  msq_functional_def gyroid_def; /* the default function */
  check(msq_functional_def_init(&gyroid_def, sizeof gyroid_def));
  gyroid_def.kind = MSQ_FUNCTIONAL_SHEET;
  gyroid_def.thickness.value = 0.3;
  for (int axis = 0; axis < 3; ++axis) gyroid_def.grid.cell_size[axis] = 1.6;
  msq_structure* gyroid;
  check(msq_structure_functional(context, &gyroid_def, &gyroid));

  /* Coarsest first. The solid is what all three have in common. */
  const msq_scale_def scales[3] = {{.shape = block}, {.structure = octet}, {.structure = gyroid}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 3;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_points_def sample;
  check(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis) sample.counts[axis] = 64, sample.spacing[axis] = 0.5;

  /* A picture from afar needs the block alone, one from near by all scales. */
  const double length_scales[3] = {INFINITY, 8, 0};
  double fractions[3];
  for (int i = 0; i < 3; ++i) {
    msq_query_def query;
    check(msq_query_def_init(&query, sizeof query));
    query.length_scale = length_scales[i];
    msq_estimate solid;
    check(msq_volume_fraction(model, &sample, &query, MSQ_PHASE_SOLID, &solid, NULL));
    fractions[i] = solid.value;
    printf("length scale %4g: %d of 3 scales resolved, %5.1f %% solid\n", length_scales[i], i + 1,
           100 * solid.value);
  }

  msq_model_release(model);
  msq_structure_release(gyroid);
  msq_structure_release(octet);
  msq_shape_release(block);
  msq_context_release(context);
  return !(fractions[0] == 1 && fractions[1] < 0.6 && fractions[2] < 0.8 * fractions[1] &&
           fractions[2] > 0);
}
