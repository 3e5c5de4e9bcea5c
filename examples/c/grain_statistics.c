/* SPDX-License-Identifier: Apache-2.0
 *
 * Measures the solid fraction and the two-point correlation of structures that the host computes
 * (grains.c), and compares them with their closed forms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "grains.h"

enum { pairs = 30000 };

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "grain_statistics: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_model* fill_box(msq_context* context, msq_shape* box, grains* g) {
  msq_host_structure_def def;
  check(msq_host_structure_def_init(&def, sizeof def));
  grains_define(g, &def);
  msq_structure* structure;
  check(msq_structure_host(context, &def, &structure));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = structure}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_structure_release(structure); /* the model holds it */
  return model;
}

/* Of random pairs of points a distance apart: how many have the first inside, or both outside. */
static void count_pairs(const msq_model* model, double distance, uint64_t* first,
                        uint64_t* neither) {
  static double points[2 * pairs][3];
  static uint8_t inside[2 * pairs];
  for (uint64_t i = 0; i < pairs; ++i)
    for (uint64_t axis = 0; axis < 3; ++axis) {
      points[2 * i][axis] = 2 + 196 * grains_uniform(77, 3 * i + axis);
      points[2 * i + 1][axis] = points[2 * i][axis] + (axis == i % 3 ? distance : 0);
    }
  msq_points_def set;
  check(msq_points_def_init(&set, sizeof set));
  set.coordinates = points;
  set.count = 2 * pairs;
  check(msq_set_membership(model, &set, NULL, inside, 2 * pairs, NULL));
  *first = *neither = 0;
  for (uint64_t i = 0; i < 2 * pairs; i += 2) {
    *first += inside[i];
    *neither += !inside[i] && !inside[i + 1];
  }
}

/* Prints what was measured beside what ought to be; whether it is 4 standard errors off. */
static int is_off(const char* what, double distance, uint64_t hits, double expected) {
  const double error = sqrt(expected * (1 - expected) / pairs), got = (double)hits / pairs;
  printf("%-36s %5.2f %10.5f %10.5f %6.1f\n", what, distance, got, expected,
         (got - expected) / error);
  return fabs(got - expected) > 4 * error;
}

int main(void) {
  const double min[3] = {0, 0, 0}, max[3] = {200, 200, 200};
  grains overlapping = {0.3, 6, 0, 1}, apart = {0.3, 6, 1, 2};
  msq_context* context;
  msq_shape* box;
  check(msq_context_create(NULL, &context));
  check(msq_shape_from_box(context, min, max, &box));
  msq_model* models[2] = {fill_box(context, box, &overlapping), fill_box(context, box, &apart)};

  const double ball = 4 * 3.14159265358979 / 3 * pow(0.3, 3), eta = 6 * ball; /* reduced density */
  uint64_t solid, both_void;
  int off = 0;
  printf("%-36s %5s %10s %10s %6s\n", "", "at", "measured", "expected", "errors");
  for (int step = 0; step <= 5; ++step) {
    const double t = 0.5 * step; /* in radii */
    count_pairs(models[0], 0.3 * t, &solid, &both_void);
    if (step == 0) off += is_off("overlapping: solid fraction", 0, solid, 1 - exp(-eta));
    const double exponent = t < 2 ? 1 + 0.75 * t - t * t * t / 16 : 2;
    off += is_off("overlapping: void, two-point", 0.3 * t, both_void, exp(-eta * exponent));
  }
  count_pairs(models[1], 0, &solid, &both_void);
  off += is_off("apart: solid fraction", 0, solid, (1 - exp(-8 * eta)) / 8);

  for (int i = 0; i < 2; ++i) msq_model_release(models[i]);
  msq_shape_release(box);
  msq_context_release(context);
  return off;
}
