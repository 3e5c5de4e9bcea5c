/* SPDX-License-Identifier: Apache-2.0
 * A structure that the program computes itself: a ball in the middle of each cell. One callback
 * suffices; msq does the rest, here layers and the volume. */
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "host_structure: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* Whether points are solid: a function of the cell and the position in it, in model units. */
static int32_t inside(void* user, const msq_host_points* points, uint8_t* inside) {
  const double radius = *(const double*)user;
  for (uint64_t i = 0; i < points->count; ++i) {
    const double* q = points->positions + 3 * i; /* from the corner of the point's cell */
    const double x = q[0] - 3, y = q[1] - 3, z = q[2] - 3;
    inside[i] = x * x + y * y + z * z <= radius * radius;
  }
  return 0; /* any other code stops the call with MSQ_E_HOST */
}

/* Optional: how far the next surface is. Rays and distances then need no small steps. The ball of
 * a point's own cell is the nearest one, since the centres form a cubic grid. */
static int32_t distance(void* user, const msq_host_points* points, double* distances) {
  const double radius = *(const double*)user;
  for (uint64_t i = 0; i < points->count; ++i) {
    const double* q = points->positions + 3 * i;
    const double x = q[0] - 3, y = q[1] - 3, z = q[2] - 3;
    distances[i] = sqrt(x * x + y * y + z * z) - radius; /* the sign is ignored */
  }
  return 0;
}

int main(void) {
  static double radius = 2.5;
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {0, 0, 0}, max[3] = {36, 18, 12};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));
  msq_host_structure_def def;
  check(msq_host_structure_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 6;
  def.concurrent = 1; /* the callbacks change nothing, so all threads may call them at once */
  def.inside = inside;
  def.distance = distance;
  def.user = &radius; /* must live as long as the structure */
  msq_structure* balls;
  check(msq_structure_host(context, &def, &balls));

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = balls}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.output = MSQ_LAYER_BYTES;
  plan.resolution[0] = 72;
  plan.resolution[1] = 18;
  plan.layer_height = 1;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  static uint8_t pixels[18][72];
  check(msq_slice_layer(slicer, 2, &pixels[0][0], sizeof pixels, NULL));
  for (int y = 18; y-- > 0; putchar('\n'))
    for (int x = 0; x < 72; ++x) putchar(pixels[y][x] ? '#' : '.');

  msq_points_def sample;
  check(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 2;
  const uint64_t counts[3] = {72, 36, 24};
  for (int axis = 0; axis < 3; ++axis)
    sample.counts[axis] = counts[axis], sample.spacing[axis] = 0.5;
  msq_estimate solid;
  check(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &solid, NULL));
  const double expected = 4 * 3.14159265358979 / 3 * 2.5 * 2.5 * 2.5 / (6 * 6 * 6);
  printf("solid: %.4f +- %.4f; of balls %.4f\n", solid.value, solid.standard_error, expected);

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(balls);
  msq_shape_release(box);
  msq_context_release(context);
  const double error = (solid.value - expected) / solid.standard_error;
  return !(error > -5 && error < 5);
}
