/* SPDX-License-Identifier: Apache-2.0 */
#include "hashes.h"
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;
static msq_channel channels[2] = {{"density", {2.5, NULL}}, {"modulus", {7, NULL}}};

static void hash_and_release(msq_material* material, uint8_t hash[hash_bytes]) {
  assert_ok(msq_material_hash(material, hash));
  msq_material_release(material);
}

static void hash_plain(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_material* material;
  assert_ok(msq_material_create(in, (const msq_material_def*)def, &material));
  hash_and_release(material, hash);
}

static void materials_hash_id_and_channels(void** state) {
  msq_material_def def = material_def(7, channels, 1);
  msq_field* field = ramp_of(context, 0, 1);
  uint8_t hash[hash_bytes];
  (void)state;
  hash_plain(context, &def, hash);
  assert_hash(hash, "5a0ce97a1bdf15668277ded3ed432165");
  def.channel_count = 2;
  HASHES(context, "msq_material_def", &def, sizeof def, hash_plain) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.channels);
    CHANGES(def.id, def.id = 8);
    CHANGES(def.channel_count, def.channel_count = 1);
    CHANGES(def.channel_count, def.channel_count = 0);
    for (int c = 0; c < 2; ++c) {
      CHANGES_BEHIND(char const*, channels[c].name, c ? "modulus " : "colour");
      CHANGES_BEHIND(double, channels[c].value.value, 3);
      CHANGES_BEHIND(msq_field const*, channels[c].value.field, field);
    }
  }
  msq_field_release(field);
}

typedef struct blend {
  const msq_material *a, *b;
  msq_param fraction;
  uint32_t id, unused;
} blend;

static void hash_blend(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const blend* made = (const blend*)def;
  msq_material* material;
  assert_ok(msq_material_blend(in, made->id, made->a, made->b, &made->fraction, &material));
  hash_and_release(material, hash);
}

static void blends_hash_their_materials(void** state) {
  msq_material *a = make_material(context, 1, 2, 3), *b = make_material(context, 2, 3, 4),
               *same = make_material(context, 1, 2, 3);
  msq_field* field = ramp_of(context, 0, 1);
  blend def = {a, b, {0.5, NULL}, 9, 0};
  (void)state;
  HASHES(context, "blend", &def, sizeof def, hash_blend) {
    KEEPS(def.a, def.a = same);
    CHANGES(def.a, def.a = b);
    CHANGES(def.b, def.b = a);
    CHANGES(def.b, def.a = b; def.b = a);
    CHANGES(def.fraction.value, def.fraction.value = 0.25);
    CHANGES(def.fraction.field, def.fraction.field = field);
    CHANGES(def.id, def.id = 10);
    NOT_HASHED(def.unused);
  }
  msq_field_release(field);
  msq_material_release(same);
  msq_material_release(b);
  msq_material_release(a);
}

/* Each of the nested materials is hashed once. */
static void nested_blends_take_linear_time(void** state) {
  msq_material *made = make_material(context, 1, 2, 3), *other = make_material(context, 1, 2, 3);
  const msq_param half = {0.5, NULL};
  uint8_t hash[hash_bytes];
  (void)state;
  for (uint32_t depth = 0; depth < 64; ++depth) {
    msq_material* next;
    assert_ok(msq_material_blend(context, depth + 2, made, other, &half, &next));
    msq_material_release(made);
    made = next;
  }
  hash_and_release(made, hash);
  msq_material_release(other);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(materials_hash_id_and_channels),
      cmocka_unit_test(blends_hash_their_materials),
      cmocka_unit_test(nested_blends_take_linear_time),
  };
  if (!MSQ_WITH_XXHASH) return 0;
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
