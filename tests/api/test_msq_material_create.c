/* SPDX-License-Identifier: Apache-2.0
 * msq_material_def_init, msq_material_create, msq_material_retain, msq_material_release. */
#include "materials.h"

DEFINE_INIT(material_def)

DEFINE_CREATE(material, material_create, material_def)

static void def_init_honours_every_size(void** state) {
  (void)state;
  check_def_init(init_material_def, sizeof(msq_material_def));
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  const msq_channel channels[2] = {{"density", {1, NULL}}, {"modulus", {-2, NULL}}};
  const msq_material_def def = material_def(7, channels, 2);
  (void)state;
  check_def_sizes(&def, sizeof def, create, context);
  msq_context_release(context);
}

static void wrong_definitions_are_refused(void** state) {
  msq_context* context = make_context();
  char name[257];
  msq_channel channels[257] = {{"density", {1, NULL}}, {"modulus", {2, NULL}}};
  msq_material_def def = material_def(7, channels, 2);
  (void)state;
  assert_refused(create(NULL, &def), MSQ_E_ARGUMENT, "context is NULL");
  assert_refused(create(context, NULL), MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(msq_material_create(context, &def, NULL), MSQ_E_ARGUMENT, "material is NULL");
  def.id = 0;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "id is 0");
  def.id = 7;
  def.channel_count = 257;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "channel_count is 257");
  def.channel_count = 2;
  def.channels = NULL;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "channels is NULL");
  def.channels = channels;
  channels[1].name = NULL;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "channel 1 is NULL");
  channels[1].name = "";
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "channel 1 has none");
  memset(name, 'a', sizeof name);
  name[256] = 0;
  channels[1].name = name;
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "channel 1 has more");
  name[255] = 0;
  assert_ok(create(context, &def));
  channels[1].name = "density";
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "two channels are called density");
  channels[1].name = "modulus";
  for (int i = 0; i < 3; ++i) {
    channels[1].value.value = not_finite(i);
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "modulus");
  }
  msq_context_release(context);
}

static void a_model_keeps_its_materials(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_material_model(context, 1, 1, 1);
  uint32_t id = 9;
  (void)state;
  msq_context_release(context);
  assert_ok(msq_point_material(model, material_points[0], NULL, NULL, 0, &id, NULL));
  assert_int_equal(id, 2);
  msq_model_release(model);
  msq_material_retain(NULL);
  msq_material_release(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(def_init_honours_every_size),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(wrong_definitions_are_refused),
      cmocka_unit_test(a_model_keeps_its_materials),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
