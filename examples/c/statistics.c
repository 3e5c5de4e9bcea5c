/* SPDX-License-Identifier: Apache-2.0
 * Finds the radius for a foam that is 20 % solid, and measures the foam: volume fraction, two-point
 * correlation and lineal path of its pores, each with its standard error. */
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "statistics: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_structure* make_foam(msq_context* context, double radius) {
  msq_foam_def def; /* cells of size 1 */
  check(msq_foam_def_init(&def, sizeof def));
  def.radius.value = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  return foam;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  msq_structure* trial = make_foam(context, 0.1);
  enum { pair_count = 64 }; /* of the curve between radius and solid fraction */
  double radii[pair_count], fractions[pair_count];
  msq_calibration_report found = {.struct_size = sizeof found};
  check(msq_structure_calibrate(context, trial, NULL, 0.2, radii, fractions, pair_count, &found,
                                NULL));
  int tenth = 0;
  while (fractions[tenth] < 0.1) ++tenth;
  printf("radius %.4f for 20 %% solid; %.4f for %.1f %%\n", found.parameter, radii[tenth],
         100 * fractions[tenth]);
  msq_structure* foam = make_foam(context, found.parameter);

  /* All space, so that no segment meets the end of the foam. */
  msq_shape* space;
  check(msq_shape_all_space(context, &space));
  const msq_scale_def scales[2] = {{.shape = space}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_points_def
      sample; /* 16 cells of the foam a side, two random points in each box of 2/3 cell */
  check(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  for (int axis = 0; axis < 3; ++axis) sample.counts[axis] = 24, sample.spacing[axis] = 2.0 / 3;
  sample.per_cell = 2;
  msq_estimate solid;
  check(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &solid, NULL));
  printf("measured: %.4f +- %.4f\n", solid.value, solid.standard_error);

  enum { length_count = 6 };
  double lengths[length_count];
  for (int i = 0; i < length_count; ++i) lengths[i] = 0.4 * i;
  msq_segments_def segments;
  check(msq_segments_def_init(&segments, sizeof segments));
  segments.phase = MSQ_PHASE_VOID;
  segments.lengths = lengths;
  segments.length_count = length_count;
  msq_estimate both_ends[length_count], whole[length_count];
  check(msq_two_point_correlation(model, &sample, NULL, &segments, both_ends, length_count, NULL));
  check(msq_lineal_path(model, &sample, NULL, &segments, whole, length_count, NULL));
  int wrong = 0;
  printf("length  both ends in a pore    whole segment in a pore\n");
  for (int i = 0; i < length_count; ++i) {
    printf("%6.2f  %.4f +- %.4f       %.4f +- %.4f\n", lengths[i], both_ends[i].value,
           both_ends[i].standard_error, whole[i].value, whole[i].standard_error);
    wrong += !(whole[i].value <= both_ends[i].value + 1e-9);
    wrong += i > 0 && !(whole[i].value <= whole[i - 1].value + 1e-9);
  }

  msq_model_release(model);
  msq_shape_release(space);
  msq_structure_release(foam);
  msq_structure_release(trial);
  msq_context_release(context);
  return wrong != 0 || !(fabs(solid.value - 0.2) < 0.01);
}
