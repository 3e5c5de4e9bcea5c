/* SPDX-License-Identifier: Apache-2.0 */
#include <pthread.h>

#include "hashes.h"
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;

static void hash_and_release(msq_model* model, uint8_t hash[hash_bytes]) {
  assert_ok(msq_model_hash(model, hash));
  msq_model_release(model);
}

static void hash_model(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_model* model;
  assert_ok(msq_model_create(in, (const msq_model_def*)def, &model));
  hash_and_release(model, hash);
}

/* The scales of a model as one value, whose fields are named like those of a definition. */
static void hash_scales(msq_context* in, const void* scales, uint8_t hash[hash_bytes]) {
  msq_model_def def;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = (const msq_scale_def*)scales;
  def.scale_count = 3;
  hash_model(in, &def, hash);
}

static void models_hash_their_scales(void** state) {
  msq_shape *box = make_box(context), *same_box = make_box(context), *sphere;
  msq_structure *foam = make_foam(context, MSQ_FOAM_AUTO),
                *same_foam = make_foam(context, MSQ_FOAM_DIRECT), *lattice = make_lattice(context);
  msq_material *one = make_material(context, 1, 2, 3), *two = make_material(context, 2, 3, 4),
               *same_one = make_material(context, 1, 2, 3);
  msq_field* field = ramp_of(context, 0, 1);
  const double center[3] = {2, 2, 2};
  msq_scale_def scales[3] = {{.shape = box}, {.structure = foam}, {.structure = lattice}};
  msq_model_def def;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 2, &sphere));
  HASHES(context, "msq_scale_def", scales, sizeof scales, hash_scales) {
    KEEPS(scales[0].shape, scales[0].shape = same_box);
    CHANGES(scales[0].shape, scales[0].shape = sphere);
    CHANGES(scales[0].material, scales[0].material = one);
    CHANGES(scales[0].material, scales[0].material = two);
    NOT_HASHED(scales[0].structure);
    NOT_HASHED(scales[0].skin);
    NOT_HASHED(scales[0].skin_material);
    for (int s = 1; s < 3; ++s) {
      NOT_HASHED(scales[s].shape);
      CHANGES(scales[s].structure, scales[s].structure = s == 1 ? lattice : foam);
      CHANGES(scales[s].skin.value, scales[s].skin.value = 0.25);
      CHANGES(scales[s].skin.value, scales[s].skin.value = 0.5);
      CHANGES(scales[s].skin.field, scales[s].skin.field = field);
      KEEPS(scales[s].skin, scales[s].skin.value = -0.0);
      CHANGES(scales[s].material, scales[s].material = one);
      CHANGES(scales[s].material, scales[s].material = two);
      CHANGES(scales[s].skin_material, scales[s].skin_material = one);
    }
    KEEPS(scales[1].structure, scales[1].structure = same_foam);
    CHANGES(scales, scales[1].structure = lattice; scales[2].structure = foam);
  }
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 3;
  def.scale_size = sizeof scales[0];
  HASHES(context, "msq_model_def", &def, sizeof def, hash_model) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.scales);
    NOT_HASHED(def.reserved);
    CHANGES(def.scale_count, def.scale_count = 1);
    CHANGES(def.scale_count, def.scale_count = 2);
    KEEPS(def.scale_size, def.scale_size = 0);
  }
  /* Materials that are equal are one. */
  uint8_t hash[hash_bytes], other[hash_bytes];
  scales[0].material = one;
  hash_model(context, &def, hash);
  scales[0].material = same_one;
  hash_model(context, &def, other);
  assert_memory_equal(hash, other, hash_bytes);
  msq_field_release(field);
  msq_material_release(same_one);
  msq_material_release(two);
  msq_material_release(one);
  msq_structure_release(lattice);
  msq_structure_release(same_foam);
  msq_structure_release(foam);
  msq_shape_release(sphere);
  msq_shape_release(same_box);
  msq_shape_release(box);
}

typedef struct regions {
  const msq_model* list[3];
  uint64_t count;
} regions;

static void hash_regions(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const regions* made = (const regions*)def;
  msq_model* model;
  assert_ok(msq_model_regions(in, made->list, made->count, &model));
  hash_and_release(model, hash);
}

static void regions_hash_in_their_order(void** state) {
  msq_model *box = make_box_model(context), *lattice = make_lattice_model(context),
            *foam = make_foam_model(context, MSQ_FOAM_AUTO), *same = make_lattice_model(context),
            *inner;
  regions def = {{box, lattice, foam}, 2};
  (void)state;
  assert_ok(msq_model_regions(context, def.list, 2, &inner));
  HASHES(context, "regions", &def, sizeof def, hash_regions) {
    CHANGES(def.count, def.count = 1);
    CHANGES(def.count, def.count = 3);
    CHANGES(def.list, def.list[0] = lattice; def.list[1] = box); /* the priority */
    CHANGES(def.list[1], def.list[1] = foam);
    KEEPS(def.list[1], def.list[1] = same);
    KEEPS(def.list[0], def.list[0] = inner; def.count = 1); /* is replaced by its regions */
  }
  msq_model_release(inner);
  msq_model_release(same);
  msq_model_release(foam);
  msq_model_release(lattice);
  msq_model_release(box);
}

static void models_have_the_hash_of_their_definition(void** state) {
  msq_channel channel = {"density", {2.5, NULL}};
  const msq_material_def of = material_def(7, &channel, 1);
  msq_material* material;
  msq_shape* box = make_box(context);
  msq_structure* foam = make_foam(context, MSQ_FOAM_AUTO);
  uint8_t hash[hash_bytes];
  msq_model_def def;
  (void)state;
  assert_ok(msq_material_create(context, &of, &material));
  const msq_scale_def scales[2] = {{.shape = box, .material = material},
                                   {.structure = foam, .skin = {0.25, NULL}}};
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  hash_model(context, &def, hash);
  assert_hash(hash, "ddc236b0bdebcbb47b2da4ff401de0b5");
  msq_structure_release(foam);
  msq_shape_release(box);
  msq_material_release(material);
}

/* Threads that ask at once for what the first of them computes. */
static const msq_model* shared;

static void* hash_shared(void* hash) {
  assert_ok(msq_model_hash(shared, (uint8_t*)hash));
  return NULL;
}

static void threads_share_a_hash(void** state) {
  enum { threads = 4 };
  pthread_t running[threads];
  uint8_t hashes[threads][hash_bytes];
  msq_model* model = make_model(context, make_cube_mesh(context), make_lattice(context), NULL);
  (void)state;
  shared = model;
  for (int i = 0; i < threads; ++i)
    assert_int_equal(pthread_create(&running[i], NULL, hash_shared, hashes[i]), 0);
  for (int i = 0; i < threads; ++i) pthread_join(running[i], NULL);
  for (int i = 1; i < threads; ++i) assert_memory_equal(hashes[i], hashes[0], hash_bytes);
  msq_model_release(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(models_hash_their_scales),
      cmocka_unit_test(regions_hash_in_their_order),
      cmocka_unit_test(models_have_the_hash_of_their_definition),
      cmocka_unit_test(threads_share_a_hash),
  };
  if (!MSQ_WITH_XXHASH) return 0;
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
