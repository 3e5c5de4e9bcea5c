/* SPDX-License-Identifier: Apache-2.0
 * A sampled map: cells that are sheared and bent, in a turned box. */
#ifndef MAPS_H
#define MAPS_H

#include "fixtures.h"

enum { map_x = 13, map_y = 11, map_z = 9, map_samples = map_x * map_y * map_z };
static const double map_origin[3] = {-1.55, -1.3, -1.15}, map_spacing[3] = {0.27, 0.26, 0.3};
static double map_rotation[9];
/* The three coordinates at the samples. */
static double map_values[3][map_samples];

/* The map that is sampled, of a position in the frame of the samples. */
static inline void map_function(const double g[3], double u[3]) {
  u[0] = 1.9 * g[0] + 0.45 * g[1] + 0.15 * sin(1.4 * g[2]) - 0.3;
  u[1] = 1.6 * g[1] + 0.2 * sin(1.2 * g[0] + 0.3) + 0.1 * g[2] * g[0] + 3.4;
  u[2] = 1.3 * g[2] - 0.15 * g[0] + 0.07 * g[1] * g[1] - 2.2;
}

static inline void sample_map(void) {
  const double c = cos(0.3), s = sin(0.3), made[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  memcpy(map_rotation, made, sizeof made);
  for (int i = 0; i < map_samples; ++i) {
    const double g[3] = {map_spacing[0] * (i % map_x), map_spacing[1] * (i / map_x % map_y),
                         map_spacing[2] * (i / map_x / map_y)};
    double u[3];
    map_function(g, u);
    for (int axis = 0; axis < 3; ++axis) map_values[axis][i] = u[axis];
  }
}

static inline msq_image map_image(const double* values) {
  msq_grid_field_def def;
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  msq_image image = def.image;
  image.values = values;
  image.value_type = MSQ_FLOAT64;
  image.size[0] = map_x;
  image.size[1] = map_y;
  image.size[2] = map_z;
  memcpy(image.grid.origin, map_origin, sizeof map_origin);
  memcpy(image.grid.cell_size, map_spacing, sizeof map_spacing);
  memcpy(image.grid.rotation, map_rotation, sizeof map_rotation);
  return image;
}

static inline msq_field* make_grid_field(msq_context* context, const msq_image* image) {
  msq_grid_field_def def;
  msq_field* field;
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  def.image = *image;
  assert_ok(msq_field_grid(context, &def, &field));
  return field;
}

/* The caller releases the fields. */
static inline msq_warp_def sampled_warp(msq_context* context, msq_field* fields[3]) {
  msq_warp_def def;
  assert_ok(msq_warp_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) {
    const msq_image image = map_image(map_values[axis]);
    fields[axis] = make_grid_field(context, &image);
  }
  def.kind = MSQ_WARP_SAMPLED;
  def.u = fields[0];
  def.v = fields[1];
  def.w = fields[2];
  return def;
}

/* Of a point of the model in the frame of the samples. */
static inline void map_position(const double p[3], double g[3]) {
  for (int axis = 0; axis < 3; ++axis) {
    g[axis] = 0;
    for (int i = 0; i < 3; ++i) g[axis] += map_rotation[3 * i + axis] * (p[i] - map_origin[i]);
  }
}

/* How far a position in that frame is within the box of the samples; negative outside. */
static inline double map_within(const double g[3]) {
  const int size[3] = {map_x, map_y, map_z};
  double within = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    within = fmin(within, g[axis]);
    within = fmin(within, map_spacing[axis] * (size[axis] - 1) - g[axis]);
  }
  return within;
}

/* The interpolated map: a mean of 8 samples, weighted. */
static inline void map_at(const double g[3], double u[3]) {
  const int size[3] = {map_x, map_y, map_z};
  int at[3];
  double f[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double x = g[axis] / map_spacing[axis];
    at[axis] = (int)fmax(0, fmin(floor(x), size[axis] - 2));
    f[axis] = x - at[axis];
  }
  u[0] = u[1] = u[2] = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double weight = (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]);
    const int i = ((at[2] + z) * map_y + at[1] + y) * map_x + at[0] + x;
    for (int axis = 0; axis < 3; ++axis) u[axis] += weight * map_values[axis][i];
  }
}

#endif
