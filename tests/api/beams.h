/* SPDX-License-Identifier: Apache-2.0 */
/* Beams that the tests of msq_structure_beams share. */
#ifndef MSQ_TEST_BEAMS_H
#define MSQ_TEST_BEAMS_H

#include "definitions.h"
#include "layers.h"

/* A refusal leaves the handle alone. */
static inline msq_status create(void* env, void* def) {
  msq_structure* made = (msq_structure*)untouched();
  const msq_status status =
      msq_structure_beams((msq_context*)env, (const msq_beams_def*)def, &made, NULL);
  if (status == MSQ_OK)
    msq_structure_release(made);
  else
    assert_ptr_equal(made, untouched());
  return status;
}

enum { node_count = 9, beam_count = 7, ball_count = 2 };

/* Numbers that float32 has. */
static const double nodes[node_count][3] = {{-2, -2, -2},    {2, -1.5, -2},    {1.5, 2, 0.25},
                                            {-1.75, 1.5, 2}, {0, 0, 0},        {0.125, 0.25, 1.5},
                                            {-1, -2, 1.625}, {1.75, -1, 1.75}, {1.25, -0.5, -0.75}};
static const uint32_t beams[beam_count][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                              {4, 5}, {6, 7}, {8, 8}};
static const double radii[beam_count][2] = {{0.5, 0.5}, {0.25, 0.75}, {0.75, 0},  {0.5, 0.25},
                                            {1, 0.5},   {0.25, 0.5},  {0.5, 0.25}};
static const uint8_t caps[beam_count][2] = {{0, 1}, {1, 1}, {0, 2}, {2, 1}, {0, 0}, {2, 2}, {0, 1}};
static const uint32_t balls[ball_count] = {6, 2};
static const double ball_radii[ball_count] = {0.5, 0.875};

/* Beams of all forms, and two balls. */
static inline msq_beams_def frame_def(void) {
  msq_beams_def def;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = nodes;
  def.node_count = node_count;
  def.beams = beams[0];
  def.beam_count = beam_count;
  def.radii = radii;
  def.caps = caps[0];
  def.balls = balls;
  def.ball_count = ball_count;
  def.ball_radii = ball_radii;
  return def;
}

/* One beam from (-1, 0, 0) to (1, 0, 0). */
static inline msq_beams_def beam_def(double radius, int32_t cap) {
  static const double ends[2][3] = {{-1, 0, 0}, {1, 0, 0}};
  static const uint32_t pair[2] = {0, 1};
  msq_beams_def def;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = ends;
  def.node_count = 2;
  def.beams = pair;
  def.beam_count = 1;
  def.radius = radius;
  def.cap = cap;
  return def;
}

/* In a box from -4 to 4. */
static inline msq_model* model_of(msq_context* context, const msq_beams_def* def) {
  msq_structure* structure;
  assert_ok(msq_structure_beams(context, def, &structure, NULL));
  return make_model(context, make_box_of(context, -4, 4), structure, NULL);
}

#endif
