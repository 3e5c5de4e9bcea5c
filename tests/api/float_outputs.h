/* SPDX-License-Identifier: Apache-2.0
 * Outputs of a model and of a structure, in the host's floating-point environment: onsets,
 * contours, fill lines, a preview mesh, findings, struts, hashes. */
#ifndef FLOAT_OUTPUTS_H
#define FLOAT_OUTPUTS_H

#include "float_states.h"

static inline int32_t take_surface(void* user, const msq_surface_slab* slab) {
  (void)user;
  check_state();
  note(slab->vertices, slab->vertex_count * 3 * sizeof(double));
  note(slab->normals, slab->vertex_count * 3 * sizeof(float));
  note(slab->triangles, slab->triangle_count * 3 * sizeof(uint32_t));
  return 0;
}

static inline int32_t take_findings(void* user, const msq_finding* findings, uint64_t count) {
  (void)user;
  check_state();
  note(findings, count * sizeof *findings);
  return 0;
}

static inline int32_t take_struts(void* user, const msq_strut* struts, uint64_t count) {
  (void)user;
  check_state();
  note(struts, count * sizeof *struts);
  return 0;
}

static inline void ask_onsets(msq_context* context, const msq_structure* structure) {
  static double coordinates[40][3], onsets[40], gradients[120];
  uint64_t state = 5;
  msq_points_def array;
  for (int i = 0; i < 40; ++i)
    for (int axis = 0; axis < 3; ++axis) coordinates[i][axis] = random_between(&state, 0, 2);
  memset(onsets, 0, sizeof onsets);
  memset(gradients, 0, sizeof gradients);
  CALL(msq_points_def_init(&array, sizeof array));
  array.coordinates = coordinates;
  array.count = 40;
  CALL(msq_set_onset(context, structure, &array, MSQ_ONSET_SIGNED, onsets, 40, gradients, 120,
                     NULL));
  NOTE(onsets), NOTE(gradients);
}

static inline void ask_contours(const msq_model* model) {
  msq_contours_def def;
  msq_contours* contours = NULL;
  msq_contours_report report;
  CALL(msq_contours_def_init(&def, sizeof def));
  def.tolerance = 0.05;
  def.topology_samples = 4;
  CALL(msq_layer_contours(model, 0.77, &def, &contours, NULL));
  if (!contours) return;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  CALL(msq_contours_info(contours, &report));
  note(report.points, report.point_count * 2 * sizeof(double));
  NOTE(report.ring_count);
  IN_STATE(msq_contours_release(contours));
}

static inline void ask_fill(msq_context* context, const msq_structure* structure) {
  static const int64_t square[4][2] = {
      {100000, 100000}, {1900000, 150000}, {1800000, 1900000}, {200000, 1700000}};
  const msq_ring ring = {square, 4};
  msq_fill_def def;
  msq_fill* fill = NULL;
  msq_fill_report report;
  CALL(msq_fill_def_init(&def, sizeof def));
  def.rings = &ring;
  def.ring_count = 1;
  def.scale = 1e-6;
  def.z = 0.63;
  CALL(msq_fill_lines(context, structure, &def, &fill, NULL));
  if (!fill) return;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  CALL(msq_fill_info(fill, &report));
  note(report.points, report.point_count * 2 * sizeof(int64_t));
  IN_STATE(msq_fill_release(fill));
}

static inline void ask_surface(const msq_model* model) {
  msq_surface_def def;
  CALL(msq_surface_def_init(&def, sizeof def));
  def.has_box = 1;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 0.2;
    def.max[axis] = 1.1;
  }
  def.pitch = 0.11;
  CALL(msq_surface_mesh(model, &def, take_surface, NULL, NULL));
}

static inline void ask_printability(const msq_model* model) {
  msq_slicer_def def;
  msq_slicer* slicer = NULL;
  msq_printability_def wanted;
  msq_printability_report report;
  CALL(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = 29;
  def.layer_height = 0.21;
  CALL(msq_slicer_create(model, &def, &slicer));
  CALL(msq_printability_def_init(&wanted, sizeof wanted));
  wanted.kinds = 63;
  wanted.width = 0.3;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  CALL(msq_printability(slicer, &wanted, take_findings, NULL, &report, NULL));
  NOTE(report);
  IN_STATE(msq_slicer_release(slicer));
}

static inline void ask_struts(msq_context* context, const msq_structure* structure) {
  msq_struts_def def;
  msq_strut_graph* graph = NULL;
  CALL(msq_struts_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) def.max[axis] = 1;
  CALL(msq_structure_struts(context, structure, &def, take_struts, NULL, NULL));
  CALL(msq_structure_strut_graph(context, structure, &def, &graph, NULL));
  if (graph) IN_STATE(msq_strut_graph_release(graph));
}

/* All of them. */
static inline void ask_outputs(msq_context* context, const msq_model* model,
                               const msq_structure* structure) {
  uint8_t hash[16];
  memset(hash, 0, sizeof hash);
  CALL(msq_model_hash(model, hash));
  NOTE(hash);
  ask_onsets(context, structure);
  ask_contours(model);
  ask_fill(context, structure);
  ask_surface(model);
  ask_printability(model);
  ask_struts(context, structure);
}

#endif
