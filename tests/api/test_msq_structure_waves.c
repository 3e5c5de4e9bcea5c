/* SPDX-License-Identifier: Apache-2.0
 * msq_waves_def_init, msq_structure_waves. */
#include "definitions.h"

static void defaults_are_those_of_the_header(void** state) {
  msq_waves_def def;
  (void)state;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  assert_int_equal(def.kind, MSQ_FUNCTIONAL_NETWORK);
  assert_int_equal(def.seed, 0);
  assert_int_equal(def.count, 256);
  for (int axis = 0; axis < 3; ++axis) {
    assert_int_equal(def.tile[axis], 0);
    assert_true(def.cone_angles[axis] == (axis ? 0 : 90));
  }
  assert_default_grid(&def.grid);
  assert_true(def.level.value == 0);
  assert_null(def.level.field);
  assert_true(def.volume_fraction == 0);
}

static msq_structure* waves_of(msq_context* context, const msq_waves_def* def) {
  msq_structure* structure;
  assert_ok(msq_structure_waves(context, def, &structure));
  return structure;
}

/* The part of 30^3 wavelengths. */
static double calibrated_level(msq_context* context, msq_waves_def def, double fraction) {
  msq_structure* structure = waves_of(context, &def);
  msq_calibration_report report = {.struct_size = sizeof report};
  assert_ok(
      msq_structure_calibrate(context, structure, NULL, fraction, NULL, NULL, 0, &report, NULL));
  msq_structure_release(structure);
  return report.parameter;
}

static void fractions_are_near_those_of_a_sample(void** state) {
  msq_context* context = make_context();
  msq_waves_def def;
  (void)state;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  def.count = 300;
  /* The normal distribution is 0.3 at -0.5244; its middle half is within 0.6745. */
  assert_true(fabs(calibrated_level(context, def, 0.3) + 0.5244) < 0.06);
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 1;
  assert_true(fabs(calibrated_level(context, def, 0.5) - 0.6745) < 0.06);
  msq_context_release(context);
}

static double spread(msq_context* context, const double cones[3], int axis) {
  /* The share of neighbours, a quarter of a wavelength apart along an axis, of which just one is
   * solid. */
  enum { side = 16, count = side * side * side };
  static uint8_t first[count], second[count];
  const double low[3] = {-50, -50, -50}, high[3] = {50, 50, 50};
  msq_waves_def def;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  memcpy(def.cone_angles, cones, sizeof def.cone_angles);
  def.volume_fraction = 0.5;
  msq_structure* structure = waves_of(context, &def);
  msq_shape* box;
  assert_ok(msq_shape_from_box(context, low, high, &box));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = structure}};
  msq_model_def model_def;
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  msq_model* model;
  assert_ok(msq_model_create(context, &model_def, &model));
  msq_points_def points;
  assert_ok(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_GRID;
  for (int a = 0; a < 3; ++a) {
    points.origin[a] = -40;
    points.spacing[a] = 4.7;
    points.counts[a] = side;
  }
  assert_ok(msq_set_membership(model, &points, NULL, first, count, NULL));
  points.origin[axis] += 0.25;
  assert_ok(msq_set_membership(model, &points, NULL, second, count, NULL));
  int differ = 0;
  for (int i = 0; i < count; ++i) differ += first[i] != second[i];
  msq_model_release(model);
  msq_shape_release(box);
  msq_structure_release(structure);
  return differ / (double)count;
}

static void cones_give_directions(void** state) {
  msq_context* context = make_context();
  const double layers[3] = {0, 0, 15}, columns[3] = {15, 15, 0}, all[3] = {90, 0, 0};
  (void)state;
  assert_true(spread(context, layers, 2) > 3 * spread(context, layers, 0));
  assert_true(spread(context, columns, 0) > 2 * spread(context, columns, 2));
  assert_true(fabs(spread(context, all, 0) - spread(context, all, 2)) < 0.06);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(fractions_are_near_those_of_a_sample),
      cmocka_unit_test(cones_give_directions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
