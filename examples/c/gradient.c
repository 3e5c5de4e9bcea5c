/* SPDX-License-Identifier: Apache-2.0
 * Struts that become thicker from the bottom of a part to its top: their radius is a field. Prints
 * how much of each tenth layer is solid. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "gradient: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

enum { layer_count = 160 };

static int32_t keep_fraction(void* user, const msq_layer* layer) {
  ((double*)user)[layer->index] =
      (double)layer->inside_count / ((double)layer->width * (double)layer->height);
  return 0;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {0, 0, 0}, max[3] = {20, 20, 40};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));

  const double bottom[3] = {0, 0, 0}, top[3] = {0, 0, 40};
  msq_field* radius; /* linear between two points, constant beyond them */
  check(msq_field_gradient(context, bottom, 0.3, top, 1.0, &radius));

  msq_lattice_def lattice_def;
  check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.unit_cell = MSQ_UNIT_CELL_KELVIN;
  for (int axis = 0; axis < 3; ++axis) lattice_def.grid.cell_size[axis] = 5;
  lattice_def.radius.field = radius; /* takes the place of the number in radius.value */
  msq_structure* lattice;
  check(msq_structure_lattice(context, &lattice_def, &lattice));
  msq_field_release(radius); /* the lattice retains it */

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = lattice}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = 0.1;
  plan.layer_height = 0.25;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  static double fractions[layer_count];
  check(msq_slicer_run(slicer, 0, layer_count, keep_fraction, fractions, NULL));

  double quarters[4] = {0};
  for (int i = 0; i < layer_count; ++i) quarters[i / (layer_count / 4)] += fractions[i];
  for (int i = layer_count - 10; i >= 0; i -= 10) {
    printf("z = %5.2f mm %5.1f %% ", 0.25 * (i + 0.5), 100 * fractions[i]);
    for (int j = 0; j < (int)(60 * fractions[i]); ++j) putchar('#');
    putchar('\n');
  }

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(lattice);
  msq_shape_release(box);
  msq_context_release(context);
  return !(quarters[0] < quarters[1] && quarters[1] < quarters[2] && quarters[2] < quarters[3]);
}
