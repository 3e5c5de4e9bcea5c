/* SPDX-License-Identifier: Apache-2.0 */
#include "documents.h"

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

/* Samples of listed layers that membership of points denies. */
typedef struct counted {
  const msq_model* model;
  msq_slicer_report plan;
  uint64_t samples, wrong;
} counted;

static int32_t compare(void* user, const msq_layer* layer) {
  counted* it = (counted*)user;
  for (uint32_t j = 0; j < layer->height; ++j)
    for (uint32_t i = 0; i < layer->width; ++i) {
      const double point[3] = {it->plan.origin[0] + i * it->plan.pitch[0],
                               it->plan.origin[1] + j * it->plan.pitch[1], layer->z};
      const uint8_t byte = layer->data[j * layer->stride + i / 8];
      int32_t inside = -1;
      if (msq_point_membership(it->model, point, NULL, &inside) != MSQ_OK) return 1;
      it->wrong += (byte >> (7 - i % 8) & 1) != inside;
      ++it->samples;
    }
  return 0;
}

/* With a field, the margins of the kernels count in the greatest coordinates. */
static void listed_heights_may_be_minute(void** state) {
  static const double units[] = {1, 1e-9, 1e-20, 1e-30, 1e30};
  static const char* const names[] = {"plate_lattice", "lattice"};
  static const char* const sizes[] = {"thickness", "radius"};
  (void)state;
  if (!MSQ_WITH_JSON) skip(); /* models are documents */
  msq_context* context = make_context();
  for (int n = 0; n < 10; ++n) {
    const double unit = units[n / 2];
    char text[1024];
    double heights[8];
    counted it = {0};
    snprintf(
        text, sizeof text,
        "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"all_space\": {}}}, {\"structure\": "
        "{\"%s\": {\"grid\": {\"cell_size\": %.17g}, \"%s\": {\"gradient\": {\"from\": [%.17g, 0, "
        "0], \"from_value\": %.17g, \"to\": [%.17g, %.17g, %.17g], \"to_value\": %.17g}}}}}]}",
        names[n % 2], unit, sizes[n % 2], -3 * unit, 0.05 * unit, 3 * unit, unit, 2 * unit,
        0.2 * unit);
    for (int i = 0; i < 8; ++i) heights[i] = unit * (0.11 + 0.037 * i);
    msq_model* model = model_of(read_document(context, text));
    msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 60, 20, 0);
    def.has_region = 1;
    def.pitch[0] = def.pitch[1] = 0.0437 * unit;
    def.layer_z = heights;
    def.layer_z_count = 8;
    msq_slicer* slicer = make_slicer(model, &def);
    it.model = model;
    it.plan = plan_of(slicer);
    assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, compare, &it, NULL));
    assert_int_equal(it.samples, 9600);
    if (it.wrong) fail_msg("%s, unit %g: %d samples", names[n % 2], unit, (int)it.wrong);
    msq_slicer_release(slicer);
    msq_model_release(model);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layers_are_sampled_in_their_middle),
      cmocka_unit_test(listed_heights_come_back_and_are_copied),
      cmocka_unit_test(listed_heights_may_be_minute),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
