/* SPDX-License-Identifier: Apache-2.0 */
#include "fixtures.h"

static double height_of(const msq_slicer* slicer, uint64_t index) {
  double z = NAN;
  assert_ok(msq_slicer_layer_z(slicer, index, &z));
  return z;
}

static void layers_are_sampled_in_their_middle(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8, 8, 0.3);
  msq_slicer* slicer = make_slicer(model, &def);
  (void)state;
  for (uint64_t i = 0; i < 14; ++i) /* from the underside of the box */
    assert_near(height_of(slicer, i), ((double)i + 0.5) * 0.3, 1e-15);
  msq_slicer_release(slicer);
  def.has_region = 1;
  def.region_min[2] = -7;
  def.region_max[0] = def.region_max[1] = 1;
  slicer = make_slicer(model, &def);
  for (uint64_t i = 0; i < plan_of(slicer).layer_count; ++i)
    assert_near(height_of(slicer, i), -7 + ((double)i + 0.5) * 0.3, 1e-14);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static void listed_heights_come_back_and_are_copied(void** state) {
  const double heights[4] = {-3, 0.1, 0.25, 1e6};
  double own[4];
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 8, 8, 0);
  (void)state;
  memcpy(own, heights, sizeof own);
  def.layer_z = own;
  def.layer_z_count = 4;
  msq_slicer* slicer = make_slicer(model, &def);
  memset(own, 0xff, sizeof own);
  for (uint64_t i = 0; i < 4; ++i) assert_true(height_of(slicer, i) == heights[i]);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layers_are_sampled_in_their_middle),
      cmocka_unit_test(listed_heights_come_back_and_are_copied),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
