/* SPDX-License-Identifier: Apache-2.0
 * What is asked of a model in a floating-point environment: points and sets, statistics, layers,
 * rays. */
#ifndef FLOAT_QUESTIONS_H
#define FLOAT_QUESTIONS_H

#include "float_objects.h"

enum { points = 400, side = 9, picture_side = 12 };

static inline void ask_points(const msq_model* model) {
  static double coordinates[points][3], distances[side * side * side];
  static uint8_t inside[side * side * side];
  static uint32_t ids[points];
  static double values[points];
  const char* const names[] = {"density"};
  msq_points_def array, grid = grid_points(0.01, 1.98, side), strata;
  uint64_t state = 3;
  for (int i = 0; i < points; ++i)
    for (int axis = 0; axis < 3; ++axis)
      coordinates[i][axis] = random_between(&state, i < 4 ? -3 : 0, 2.1);
  memset(inside, 0, sizeof inside);
  memset(distances, 0, sizeof distances);
  CALL(msq_points_def_init(&array, sizeof array));
  array.coordinates = coordinates;
  array.count = points;
  strata = grid;
  strata.kind = MSQ_POINTS_STRATIFIED;
  strata.per_cell = 2;
  CALL(msq_points_generate(&strata, 3, 100, coordinates[0]));
  note(coordinates, sizeof coordinates);
  for (int i = 0; i < 12; ++i) {
    int32_t is_in = -1;
    double distance = -1;
    uint32_t id = 7;
    double value = -1;
    CALL(msq_point_membership(model, coordinates[i], NULL, &is_in));
    CALL(msq_point_distance(model, coordinates[i], NULL, &distance));
    CALL(msq_point_material(model, coordinates[i], NULL, names, 1, &id, &value));
    NOTE(is_in), NOTE(distance), NOTE(id), NOTE(value);
  }
  CALL(msq_set_membership(model, &array, NULL, inside, points, NULL));
  note(inside, points);
  CALL(msq_set_membership(model, &grid, NULL, inside, sizeof inside, NULL));
  note(inside, sizeof inside);
  CALL(msq_set_distance(model, &array, NULL, distances, points, NULL));
  note(distances, points * sizeof distances[0]);
  CALL(msq_set_material(model, &array, NULL, names, 1, ids, points, values, points, NULL));
  note(ids, sizeof ids);
  note(values, sizeof values);
}

static inline void ask_statistics(msq_context* context, const msq_model* model,
                                  const msq_structure* structure) {
  const double lengths[2] = {0.1, 0.7};
  msq_points_def sample = grid_points(0.2, 1.8, 4);
  msq_estimate estimates[2];
  msq_segments_def segments;
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 3;
  memset(estimates, 0, sizeof estimates);
  CALL(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, estimates, NULL));
  NOTE(estimates);
  CALL(msq_segments_def_init(&segments, sizeof segments));
  segments.lengths = lengths;
  segments.length_count = 2;
  CALL(msq_two_point_correlation(model, &sample, NULL, &segments, estimates, 2, NULL));
  NOTE(estimates);
  CALL(msq_lineal_path(model, &sample, NULL, &segments, estimates, 2, NULL));
  NOTE(estimates);
  if (structure) {
    msq_calibration_report report;
    double parameters[5] = {0}, fractions[5] = {0};
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    CALL(msq_structure_calibrate(context, structure, &sample, 0.2, parameters, fractions, 5,
                                 &report, NULL));
    NOTE(report), NOTE(parameters), NOTE(fractions);
  }
}

static inline void ask_layers(const msq_model* model) {
  static uint8_t layer[4096];
  msq_slicer_def def;
  msq_slicer* slicer = NULL;
  msq_slicer_report plan;
  double z = 0;
  CALL(msq_slicer_def_init(&def, sizeof def));
  def.output = MSQ_LAYER_BYTES;
  def.resolution[0] = 31;
  def.resolution[1] = 23;
  def.layer_height = 0.37;
  def.slab_layers = 2;
  CALL(msq_slicer_create(model, &def, &slicer));
  memset(&plan, 0, sizeof plan);
  plan.struct_size = sizeof plan;
  CALL(msq_slicer_info(slicer, &plan));
  NOTE(plan);
  CALL(msq_slicer_layer_z(slicer, 1, &z));
  NOTE(z);
  CALL(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, NULL, NULL));
  memset(layer, 0, sizeof layer);
  CALL(msq_slice_layer(slicer, 2, layer, sizeof layer, NULL));
  note(layer, sizeof layer);
  IN_STATE(msq_slicer_retain(slicer));
  IN_STATE(msq_slicer_release(slicer));
  IN_STATE(msq_slicer_release(slicer));
}

static inline void ask_rays(const msq_model* model) {
  enum { rays = 60 };
  static double origins[rays][3], directions[rays][3];
  static msq_ray_hit hits[rays];
  static float depth[picture_side * picture_side];
  static uint8_t rgba[4 * picture_side * picture_side];
  const double way[3] = {-0.5, 0.8, -0.4}, pixel[2] = {3.3, 7.9};
  uint64_t state = 11;
  msq_rays_def def;
  msq_camera camera;
  msq_render_def picture;
  msq_frame frame;
  double origin[3] = {0}, direction[3] = {0};
  for (int i = 0; i < rays; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      origins[i][axis] = random_between(&state, -1, 3);
      directions[i][axis] = random_between(&state, -1, 1);
    }
  CALL(msq_rays_def_init(&def, sizeof def));
  def.count = rays;
  def.origins = origins;
  def.directions = directions;
  memset(hits, 0, sizeof hits);
  CALL(msq_ray_cast(model, &def, NULL, hits, rays, NULL));
  note(hits, sizeof hits);
  CALL(msq_camera_init(&camera, sizeof camera));
  camera.projection = MSQ_CAMERA_PERSPECTIVE;
  CALL(msq_camera_fit(model, way, NULL, picture_side, picture_side, &camera));
  NOTE(camera);
  CALL(msq_camera_ray(&camera, picture_side, picture_side, pixel, origin, direction));
  NOTE(origin), NOTE(direction);
  CALL(msq_render_def_init(&picture, sizeof picture));
  picture.width = picture.height = picture_side;
  picture.samples = 2;
  picture.shadows = 1;
  picture.occlusion_rays = 2;
  CALL(msq_frame_init(&frame, sizeof frame));
  frame.depth = depth;
  frame.rgba = rgba;
  CALL(msq_render(model, &camera, &picture, NULL, &frame, take_pass, NULL, NULL));
  note(depth, sizeof depth);
  note(rgba, sizeof rgba);
}

#endif
