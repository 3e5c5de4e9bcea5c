/* SPDX-License-Identifier: Apache-2.0
 * Materials, and a model with one for each scale, that the tests of materials share. */
#ifndef MATERIALS_H
#define MATERIALS_H

#include "definitions.h"

static inline msq_material_def material_def(uint32_t id, const msq_channel* channels,
                                            uint64_t count) {
  msq_material_def def;
  assert_ok(msq_material_def_init(&def, sizeof def));
  def.id = id;
  def.channels = channels;
  def.channel_count = count;
  return def;
}

/* With a density and a modulus. */
static inline msq_material* make_material(msq_context* context, uint32_t id, double density,
                                          double modulus) {
  const msq_channel channels[2] = {{"density", {density, NULL}}, {"modulus", {modulus, NULL}}};
  const msq_material_def def = material_def(id, channels, 2);
  msq_material* material;
  assert_ok(msq_material_create(context, &def, &material));
  return material;
}

/* A box from 0 to 4 of material 1, filled with a lattice of material 2 and cell size 1, whose skin
 * of 0.25 is of material 3. Materials may be left out. */
static inline msq_model* make_material_model(msq_context* context, int has_coarse, int has_fine,
                                             int has_skin) {
  msq_material* materials[3] = {make_material(context, 1, 100, 1),
                                make_material(context, 2, 200, 2),
                                make_material(context, 3, 300, 3)};
  msq_shape* shape = make_box(context);
  msq_structure* lattice = make_lattice(context);
  msq_scale_def scales[2] = {{.shape = shape}, {.structure = lattice, .skin = {0.25, NULL}}};
  msq_model_def def;
  msq_model* model;
  if (has_coarse) scales[0].material = materials[0];
  if (has_fine) scales[1].material = materials[1];
  if (has_skin) scales[1].skin_material = materials[2];
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  assert_ok(msq_model_create(context, &def, &model));
  for (int i = 0; i < 3; ++i) msq_material_release(materials[i]);
  msq_shape_release(shape);
  msq_structure_release(lattice);
  return model;
}

/* On a strut, in a void, in the skin, outside. */
static const double material_points[4][3] = {
    {1.5, 1.5, 1.5}, {1.5, 2, 1.5}, {0.1, 2, 1.5}, {4.5, 1, 1}};
static const char* const material_channels[2] = {"modulus", "density"};

#endif
