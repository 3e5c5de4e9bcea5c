/* SPDX-License-Identifier: Apache-2.0
 * Structures for tests of the floating-point environment that have more than one part: cells that
 * are warped, walls, plates, beams, structures made of structures. Made in the host's environment:
 * what a definition needs is computed before. */
#ifndef FLOAT_KINDS_H
#define FLOAT_KINDS_H

#include "float_states.h"
#include "maps.h"

enum compound_kind {
  closed_foam,
  vented_foam,
  stretched_foam,
  weighted_foam,
  struts_and_walls,
  plates,
  waves,
  beams,
  gyroid_around_axis,
  lattice_around_point,
  gyroid_by_map,
  lattice_by_map,
  graded_period,
  union_of_two,
  blend_of_two,
  smooth_union,
  compound_kinds
};

static inline msq_status make_foam_of(msq_context* context, enum compound_kind kind,
                                      msq_structure** structure) {
  msq_foam_def def;
  msq_foam_def_init(&def, sizeof def);
  def.grid.origin[1] = 0.3;
  def.seed = 5;
  def.radius.value = kind == closed_foam || kind == vented_foam ? 0 : 0.1;
  if (kind != stretched_foam && kind != weighted_foam) def.wall_thickness.value = 0.09;
  if (kind == vented_foam) def.vent_radius.value = 0.14;
  if (kind == stretched_foam) def.stretch[2] = 1.7;
  if (kind == weighted_foam) def.weight = 0.4;
  return msq_structure_foam(context, &def, structure);
}

static inline msq_status make_beams_of(msq_context* context, msq_structure** structure) {
  static const double nodes[5][3] = {
      {0.2, 0.3, 0.1}, {1.8, 0.4, 0.3}, {1.7, 1.6, 0.2}, {0.3, 1.5, 0.4}, {1, 1.1, 1.7}};
  static const uint32_t pairs[6][2] = {{0, 1}, {1, 2}, {2, 3}, {0, 4}, {2, 4}, {3, 4}};
  static const double radii[6][2] = {{0.1, 0.2},  {0.2, 0.05}, {0.07, 0.07},
                                     {0.1, 0.03}, {0.15, 0},   {0.1, 0.1}};
  msq_beams_def def;
  msq_beams_def_init(&def, sizeof def);
  def.nodes = nodes;
  def.node_count = 5;
  def.beams = pairs[0];
  def.beam_count = 6;
  def.radii = radii;
  return msq_structure_beams(context, &def, structure, NULL);
}

static inline msq_status make_sheet_of(msq_context* context, const msq_warp_def* warp,
                                       const msq_period_def* period, msq_structure** structure) {
  msq_functional_def def;
  msq_functional_def_init(&def, sizeof def);
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.4;
  def.warp = warp;
  def.period = period;
  return msq_structure_functional(context, &def, structure);
}

static inline msq_status make_bcc_of(msq_context* context, const msq_warp_def* warp,
                                     msq_structure** structure) {
  msq_lattice_def def;
  msq_lattice_def_init(&def, sizeof def);
  def.radius.value = 0.06;
  def.warp = warp;
  return msq_structure_lattice(context, &def, structure);
}

/* fields: of a sampled map. */
static inline msq_status make_warped(msq_context* context, enum compound_kind kind,
                                     msq_structure** structure) {
  static const double positions[3] = {0, 0.9, 2}, sizes[3] = {0.5, 1.3, 0.7};
  msq_warp_def warp;
  msq_period_def period;
  msq_field* fields[3] = {NULL, NULL, NULL};
  msq_status status = MSQ_OK;
  msq_warp_def_init(&warp, sizeof warp);
  switch (kind) {
    case gyroid_around_axis:
      warp.count = 7;
      return make_sheet_of(context, &warp, NULL, structure);
    case lattice_around_point:
      warp.kind = MSQ_WARP_SPHERICAL;
      warp.count = 8;
      warp.count_polar = 5;
      warp.inner_radius = 1;
      warp.outer_radius = 3;
      return make_bcc_of(context, &warp, structure);
    case graded_period:
      msq_period_def_init(&period, sizeof period);
      period.positions = positions;
      period.cell_sizes = sizes;
      period.count = 3;
      return make_sheet_of(context, NULL, &period, structure);
    default:
      break;
  }
  warp.kind = MSQ_WARP_SAMPLED;
  for (int axis = 0; axis < 3 && status == MSQ_OK; ++axis) {
    msq_grid_field_def def;
    msq_grid_field_def_init(&def, sizeof def);
    def.image.values = map_values[axis];
    def.image.value_type = MSQ_FLOAT64;
    def.image.size[0] = map_x;
    def.image.size[1] = map_y;
    def.image.size[2] = map_z;
    memcpy(def.image.grid.origin, map_origin, sizeof map_origin);
    memcpy(def.image.grid.cell_size, map_spacing, sizeof map_spacing);
    memcpy(def.image.grid.rotation, map_rotation, sizeof map_rotation);
    status = msq_field_grid(context, &def, &fields[axis]);
  }
  warp.u = fields[0];
  warp.v = fields[1];
  warp.w = fields[2];
  if (status == MSQ_OK)
    status = kind == gyroid_by_map ? make_sheet_of(context, &warp, NULL, structure)
                                   : make_bcc_of(context, &warp, structure);
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  return status;
}

/* Of a lattice and a gyroid. */
static inline msq_status make_pair(msq_context* context, enum compound_kind kind,
                                   msq_structure** structure) {
  const msq_param part = {kind == blend_of_two ? 0.4 : 0.1, NULL};
  msq_structure* members[2] = {NULL, NULL};
  msq_status status = make_bcc_of(context, NULL, &members[0]);
  if (status == MSQ_OK) status = make_sheet_of(context, NULL, NULL, &members[1]);
  if (status == MSQ_OK) {
    if (kind == union_of_two)
      status = msq_structure_boolean(MSQ_BOOLEAN_UNION, (const msq_structure* const*)members, 2,
                                     structure);
    else if (kind == blend_of_two)
      status = msq_structure_blend(members[0], members[1], &part, structure);
    else
      status =
          msq_structure_smooth_boolean(MSQ_BOOLEAN_UNION, members[0], members[1], &part, structure);
  }
  for (int i = 0; i < 2; ++i) msq_structure_release(members[i]);
  return status;
}

/* sample_map() comes first. */
static inline msq_status make_compound(msq_context* context, enum compound_kind kind,
                                       msq_structure** structure) {
  msq_plate_lattice_def plate_def;
  msq_waves_def waves_def;
  switch (kind) {
    case closed_foam:
    case vented_foam:
    case stretched_foam:
    case weighted_foam:
    case struts_and_walls:
      return make_foam_of(context, kind, structure);
    case plates:
      msq_plate_lattice_def_init(&plate_def, sizeof plate_def);
      plate_def.plate_cell = MSQ_PLATE_CELL_CUBIC_OCTET;
      plate_def.thickness.value = 0.07;
      plate_def.radius.value = 0.05;
      return msq_structure_plate_lattice(context, &plate_def, structure);
    case waves:
      msq_waves_def_init(&waves_def, sizeof waves_def);
      waves_def.count = 24;
      waves_def.cone_angles[0] = waves_def.cone_angles[1] = 33;
      waves_def.volume_fraction = 0.37;
      return msq_structure_waves(context, &waves_def, structure);
    case beams:
      return make_beams_of(context, structure);
    case union_of_two:
    case blend_of_two:
    case smooth_union:
      return make_pair(context, kind, structure);
    default:
      return make_warped(context, kind, structure);
  }
}

#endif
