/* SPDX-License-Identifier: Apache-2.0
 * msq_material_blend. */
#include "materials.h"

static msq_material* blend(msq_context* context, msq_material* a, msq_material* b, double from,
                           double to) {
  const double bottom[3] = {0, 0, 0}, top[3] = {0, 0, 4};
  msq_param fraction = {0, NULL};
  msq_field* field;
  msq_material* material;
  assert_ok(msq_field_gradient(context, bottom, from, top, to, &field));
  fraction.field = field;
  assert_ok(msq_material_blend(context, 9, a, b, &fraction, &material));
  msq_field_release(field);
  return material;
}

static void a_blend_runs_from_one_to_the_other(void** state) {
  msq_context* context = make_context();
  msq_material *a = make_material(context, 1, 100, 1), *b = make_material(context, 2, 300, -5);
  msq_material* both = blend(context, a, b, 0, 1);
  msq_shape* shape = make_box(context);
  const msq_scale_def scale = {.shape = shape, .material = both};
  const double z[] = {0, 1, 2, 4}, density[] = {100, 150, 200, 300}, modulus[] = {1, -0.5, -2, -5};
  msq_model_def def;
  msq_model* model;
  (void)state;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = &scale;
  def.scale_count = 1;
  assert_ok(msq_model_create(context, &def, &model));
  msq_material_release(a);
  msq_material_release(b);
  msq_material_release(both);
  msq_shape_release(shape);
  for (int i = 0; i < 4; ++i) {
    const double p[3] = {1, 1, z[i]};
    double values[2];
    uint32_t id;
    assert_ok(msq_point_material(model, p, NULL, material_channels, 2, &id, values));
    assert_int_equal(id, 9);
    assert_true(values[0] == modulus[i] && values[1] == density[i]);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void at_most_64_blends_are_within_each_other(void** state) {
  msq_context* context = make_context();
  msq_material *a = make_material(context, 1, 100, 1), *last = a, *next;
  const msq_param fraction = {0.5, NULL};
  (void)state;
  msq_material_retain(a);
  for (int i = 0; i < 64; ++i) {
    assert_ok(msq_material_blend(context, 9, last, a, &fraction, &next));
    msq_material_release(last);
    last = next;
  }
  assert_refused(msq_material_blend(context, 9, last, a, &fraction, &next), MSQ_E_LIMIT, "64");
  msq_material_release(last);
  msq_material_release(a);
  msq_context_release(context);
}

/* A blend of a material with itself asks it twice: 64 of these would ask 2^64 times. */
static void at_most_4096_materials_are_asked(void** state) {
  msq_context* context = make_context();
  msq_material *last = make_material(context, 1, 100, 1), *next;
  const msq_param fraction = {0.5, NULL};
  (void)state;
  for (int i = 0; i < 12; ++i) {
    assert_ok(msq_material_blend(context, 9, last, last, &fraction, &next));
    msq_material_release(last);
    last = next;
  }
  assert_makes_nothing(msq_material, msq_material_blend(context, 9, last, last, &fraction, &made),
                       MSQ_E_LIMIT, "8192");
  msq_material_release(last);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_blend_runs_from_one_to_the_other),
      cmocka_unit_test(at_most_64_blends_are_within_each_other),
      cmocka_unit_test(at_most_4096_materials_are_asked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
