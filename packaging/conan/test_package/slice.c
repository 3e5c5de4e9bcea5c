/* SPDX-License-Identifier: Apache-2.0 */
/* Slices a box filled with a lattice, and says how much of it is solid. */
#include <msq.h>
#include <stdio.h>

static int32_t take(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count;
  return 0;
}

static int check(msq_status status) {
  if (status != MSQ_OK) fprintf(stderr, "%s: %s\n", msq_status_name(status), msq_error_message());
  return status == MSQ_OK;
}

int main(void) {
  const double min[3] = {0, 0, 0}, max[3] = {10, 10, 10};
  msq_context* context = NULL;
  msq_shape* box = NULL;
  msq_structure* lattice = NULL;
  msq_model* model = NULL;
  msq_slicer* slicer = NULL;
  msq_lattice_def def;
  msq_model_def filled;
  msq_slicer_def plan;
  msq_scale_def scales[2] = {{0}, {0}};
  uint64_t solid = 0;
  int ok = check(msq_context_create(NULL, &context)) &&
           check(msq_shape_from_box(context, min, max, &box)) &&
           check(msq_lattice_def_init(&def, sizeof def));
  if (ok) {
    int i;
    def.unit_cell = MSQ_UNIT_CELL_BCC;
    for (i = 0; i < 3; ++i) def.grid.cell_size[i] = 5;
    def.radius.value = 0.8;
    ok = check(msq_structure_lattice(context, &def, &lattice)) &&
         check(msq_model_def_init(&filled, sizeof filled));
  }
  if (ok) {
    scales[0].shape = box;
    scales[1].structure = lattice;
    filled.scales = scales;
    filled.scale_count = 2;
    filled.scale_size = sizeof scales[0];
    ok = check(msq_model_create(context, &filled, &model)) &&
         check(msq_slicer_def_init(&plan, sizeof plan));
  }
  if (ok) {
    plan.pitch[0] = plan.pitch[1] = plan.layer_height = 0.5;
    ok = check(msq_slicer_create(model, &plan, &slicer)) &&
         check(msq_slicer_run(slicer, 0, UINT64_MAX, take, &solid, NULL));
  }
  printf("msq %u: %.1f %% of the box is solid\n", (unsigned)msq_version(), (double)solid / 80);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(lattice);
  msq_shape_release(box);
  msq_context_release(context);
  return ok && solid > 0 && solid < 8000 ? 0 : 1;
}
