/* SPDX-License-Identifier: Apache-2.0
 * What the tests of struts share. */
#ifndef STRUTS_H
#define STRUTS_H

#include "definitions.h"

static inline msq_struts_def struts_def(double low, double high) {
  msq_struts_def def;
  assert_ok(msq_struts_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = low;
    def.max[axis] = high;
  }
  return def;
}

/* A truss of two beams, of which one tapers, and a ball. */
static inline msq_structure* make_truss(msq_context* context) {
  static const double nodes[4][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 0, 0}};
  static const uint32_t beams[2][2] = {{0, 1}, {3, 2}}, balls[1] = {0};
  static const double radii[2][2] = {{0.25, 0.25}, {0.5, 0.125}};
  static const uint8_t caps[2][2] = {{MSQ_CAP_SPHERE, MSQ_CAP_BUTT},
                                     {MSQ_CAP_HEMISPHERE, MSQ_CAP_SPHERE}};
  msq_beams_def def;
  msq_structure* structure;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = nodes;
  def.node_count = 4;
  def.beams = beams[0];
  def.beam_count = 2;
  def.radii = radii;
  def.caps = caps[0];
  def.balls = balls;
  def.ball_count = 1;
  def.ball_radius = 0.75;
  assert_ok(msq_structure_beams(context, &def, &structure, NULL));
  return structure;
}

/* A foam with walls of this thickness, if it is not 0; with a radius of 0, walls alone. */
static inline msq_structure* make_foam_with(msq_context* context, double radius, double walls) {
  msq_foam_def def;
  msq_structure* structure;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = radius;
  def.wall_thickness.value = walls;
  assert_ok(msq_structure_foam(context, &def, &structure));
  return structure;
}

static inline msq_structure* make_gyroid(msq_context* context) {
  msq_functional_def def;
  msq_structure* structure;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  assert_ok(msq_structure_functional(context, &def, &structure));
  return structure;
}

#endif
