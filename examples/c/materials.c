/* SPDX-License-Identifier: Apache-2.0
 * Materials of a ball: its skin is steel, its lattice goes from steel at the bottom to copper at
 * the top. Prints the material of voxels and the mass of the part. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "materials: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

enum { STEEL = 1, COPPER = 2, GRADED = 3 }; /* ids of our own; 0 is MSQ_MATERIAL_VOID */

/* A material with one channel, its density in g/cm3. Channels may be fields. */
static msq_material* make_metal(msq_context* context, uint32_t id, double density) {
  const msq_channel channel = {.name = "density", .value = {.value = density}};
  msq_material_def def;
  check(msq_material_def_init(&def, sizeof def));
  def.id = id;
  def.channels = &channel;
  def.channel_count = 1;
  msq_material* metal;
  check(msq_material_create(context, &def, &metal));
  return metal;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double center[3] = {0, 0, 0}, bottom[3] = {0, 0, -10}, top[3] = {0, 0, 10};
  msq_shape* ball;
  check(msq_shape_from_sphere(context, center, 10, &ball));
  msq_lattice_def lattice_def;
  check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  for (int axis = 0; axis < 3; ++axis) lattice_def.grid.cell_size[axis] = 4;
  lattice_def.radius.value = 0.9;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &lattice_def, &lattice));

  msq_material* steel = make_metal(context, STEEL, 7.9);
  msq_material* copper = make_metal(context, COPPER, 9.0);
  msq_field* share; /* of copper */
  check(msq_field_gradient(context, bottom, 0, top, 1, &share));
  const msq_param fraction = {.field = share};
  msq_material* graded;
  check(msq_material_blend(context, GRADED, steel, copper, &fraction, &graded));

  const msq_scale_def scales[2] = {
      {.shape = ball},
      {.structure = lattice, .material = graded, .skin = {.value = 1}, .skin_material = steel}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  enum { side = 80 }; /* voxels of 0.25 mm */
  static uint32_t ids[side * side * side];
  static double densities[side * side * side];
  msq_points_def voxels;
  check(msq_points_def_init(&voxels, sizeof voxels));
  voxels.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    voxels.counts[axis] = side;
    voxels.spacing[axis] = 0.25;
    voxels.origin[axis] = -10 + 0.125;
  }
  const char* const channels[1] = {"density"};
  const uint64_t count = side * side * side;
  check(msq_set_material(model, &voxels, NULL, channels, 1, ids, count, densities, count, NULL));

  uint64_t of[4] = {0};
  double mass = 0;
  for (uint64_t i = 0; i < count; ++i) {
    ++of[ids[i]];
    mass += densities[i] * 0.025 * 0.025 * 0.025; /* cm3 */
  }
  for (int z = side; (z -= 4) >= 0; putchar('\n')) /* a section from bottom to top */
    for (int x = 0; x < side; x += 2) putchar(" s?g"[ids[(z * side + 37) * side + x]]);
  printf("%llu voxels of steel, %llu graded; %.2f g\n", (unsigned long long)of[STEEL],
         (unsigned long long)of[GRADED], mass);

  msq_model_release(model);
  msq_material_release(graded);
  msq_material_release(copper);
  msq_material_release(steel);
  msq_field_release(share);
  msq_structure_release(lattice);
  msq_shape_release(ball);
  msq_context_release(context);
  return !(of[STEEL] > 0 && of[GRADED] > 0 && of[COPPER] == 0 && mass > 1 && mass < 4.19 * 9);
}
