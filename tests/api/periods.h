/* SPDX-License-Identifier: Apache-2.0
 * A graded period, and where its cells are by an outside integral; grids whose cells are turned. */
#ifndef PERIODS_H
#define PERIODS_H

#include "fixtures.h"

static const double turn = 6.283185307179586;

static const double positions[4] = {-1, 0.5, 0.75, 2}, sizes[4] = {1, 0.6, 0.75, 0.5};

static inline msq_period_def period_def(void) {
  msq_period_def def;
  assert_ok(msq_period_def_init(&def, sizeof def));
  def.positions = positions;
  def.cell_sizes = sizes;
  def.count = 4;
  return def;
}

/* The integral from the first position, by Simpson's rule, exact for lines. */
static inline double integral(double s) {
  double sum = 0;
  if (s < positions[0]) return (s - positions[0]) / sizes[0];
  for (int i = 0; i < 4; ++i) {
    const double end = i < 3 && positions[i + 1] < s ? positions[i + 1] : s;
    const double h = i < 3 ? sizes[i + 1] : sizes[3];
    const double part = i < 3 ? (end - positions[i]) / (positions[i + 1] - positions[i]) : 0;
    const double at_end = (1 - part) / sizes[i] + part / h;
    sum += (end - positions[i]) * 0.5 * (1 / sizes[i] + at_end);
    if (end == s) break;
  }
  return sum;
}

/* Points about the origin. */
enum { turned_side = 24 };

static inline msq_points_def turned_points(void) {
  msq_points_def points = grid_points(-1.9, -1.9 + 0.157 * (turned_side - 1), turned_side);
  for (int axis = 0; axis < 3; ++axis) points.origin[axis] += 0.01 * axis;
  return points;
}

/* The grid's coordinates of such a point, where the grid begins at (0, 0.3, 0). rotation: that of
 * the grid, about z, or NULL. */
static inline void turned_position(const msq_points_def* points, int i, const double* rotation,
                                   double g[3]) {
  const int index[3] = {i % turned_side, i / turned_side % turned_side,
                        i / turned_side / turned_side};
  double p[3];
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = points->origin[axis] + index[axis] * points->spacing[axis];
  p[1] -= 0.3;
  g[0] = rotation ? rotation[0] * p[0] + rotation[3] * p[1] : p[0];
  g[1] = rotation ? rotation[1] * p[0] + rotation[4] * p[1] : p[1];
  g[2] = p[2];
}

#endif
