/* SPDX-License-Identifier: Apache-2.0
 * What functions that hash an object refuse: besides NULL, an object of the host without a key,
 * also within another one. */
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;

static int32_t no_values(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  (void)points;
  memset(values, 0, count * sizeof *values);
  return 0;
}

static int32_t no_inside(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)user;
  (void)points;
  memset(inside, 0, count);
  return 0;
}

static int32_t no_points_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static msq_field* field_without_key(void) {
  msq_host_field_def def;
  msq_field* field;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  def.evaluate = no_values;
  def.low = 0;
  def.high = 0.25;
  assert_ok(msq_field_host(context, &def, &field));
  return field;
}

static msq_shape* shape_without_key(void) {
  msq_host_shape_def def;
  msq_shape* shape;
  assert_ok(msq_host_shape_def_init(&def, sizeof def));
  def.inside = no_inside;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 0;
    def.max[axis] = 1;
  }
  assert_ok(msq_shape_from_host(context, &def, &shape));
  return shape;
}

static msq_structure* structure_without_key(void) {
  msq_host_structure_def def;
  msq_structure* structure;
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = no_points_inside;
  assert_ok(msq_structure_host(context, &def, &structure));
  return structure;
}

static msq_structure* function_without_key(void) {
  msq_host_function_def def;
  msq_structure* structure;
  assert_ok(msq_host_function_def_init(&def, sizeof def));
  def.evaluate = no_values;
  assert_ok(msq_structure_host_function(context, &def, &structure));
  return structure;
}

/* Calls msq_<object>_hash of a good object, and of others that have no hash. */
#define HASH_ROWS(object, good, what, one, other)                          \
  do {                                                                     \
    const msq_##object* hashed = good;                                     \
    uint8_t* hash = (uint8_t*)output(0);                                   \
    WRONG(ARGUMENT, #object " is NULL", hashed = NULL);                    \
    WRONG(ARGUMENT, "hash is NULL", hash = NULL);                          \
    WRONG(UNSUPPORTED, "a " what " that the host|hash_key", hashed = one); \
    WRONG(UNSUPPORTED, "that the host|hash_key", hashed = other);          \
    TRY(msq_##object##_hash(hashed, hash));                                \
  } while (0)

static void hashes(void** state) {
  static const double matrix[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  static const double curve[2] = {0, 0.125};
  msq_shape *box = make_box(context), *shape = shape_without_key(), *placed;
  msq_field *ramp = ramp_of(context, 0, 1), *field = field_without_key(), *map;
  msq_structure *lattice = make_lattice(context), *structure = structure_without_key(),
                *function = function_without_key();
  msq_model* model = make_lattice_model(context);
  msq_material *steel = make_material(context, 1, 2, 3), *host_material, *blend;
  const msq_channel channels[2] = {{"density", {0, field}}, {"modulus", {1, NULL}}};
  const msq_material_def material = material_def(2, channels, 2);
  const msq_param half = {0.5, NULL};
  (void)state;
  assert_ok(msq_shape_placed(shape, matrix, &placed));
  assert_ok(msq_field_map(context, field, curve, 1, &map));
  assert_ok(msq_material_create(context, &material, &host_material));
  assert_ok(msq_material_blend(context, 3, steel, host_material, &half, &blend));
  REFUSALS("msq_shape_hash") HASH_ROWS(shape, box, "shape", shape, placed);
  REFUSALS("msq_field_hash") HASH_ROWS(field, ramp, "field", field, map);
  REFUSALS("msq_structure_hash") HASH_ROWS(structure, lattice, "structure", structure, function);
  REFUSALS("msq_material_hash") HASH_ROWS(material, steel, "field", host_material, blend);
  /* Takes over its parts. */
  msq_model *of_shape = make_model(context, placed, NULL, NULL),
            *of_structure = make_model(context, box, structure, NULL);
  REFUSALS("msq_model_hash") HASH_ROWS(model, model, "shape", of_shape, of_structure);
  msq_model_release(of_structure);
  msq_model_release(of_shape);
  msq_model_release(model);
  msq_material_release(blend);
  msq_material_release(host_material);
  msq_material_release(steel);
  msq_structure_release(function);
  msq_structure_release(lattice);
  msq_field_release(map);
  msq_field_release(field);
  msq_field_release(ramp);
  msq_shape_release(shape);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hashes),
  };
  if (!MSQ_WITH_XXHASH) return 0; /* test_msq_shape_hash.c */
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
