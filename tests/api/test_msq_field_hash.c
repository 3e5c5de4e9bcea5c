/* SPDX-License-Identifier: Apache-2.0 */
#include "hashes.h"
#include "wrong_values.h"

static msq_context* context;

static void hash_and_release(msq_field* field, uint8_t hash[hash_bytes]) {
  assert_ok(msq_field_hash(field, hash));
  msq_field_release(field);
}

typedef struct gradient {
  double from[3], from_value, to[3], to_value;
} gradient;

static void hash_gradient(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const gradient* g = (const gradient*)def;
  msq_field* field;
  assert_ok(msq_field_gradient(in, g->from, g->from_value, g->to, g->to_value, &field));
  hash_and_release(field, hash);
}

static void gradients_hash_their_numbers(void** state) {
  gradient def = {{0, 0, 0}, 0.5, {0, 0, 10}, 2};
  uint8_t hash[hash_bytes];
  (void)state;
  hash_gradient(context, &def, hash);
  assert_hash(hash, "851d3a78b91f8e5dd5e2343042eeec64");
  HASHES(context, "gradient", &def, sizeof def, hash_gradient) {
    for (int axis = 0; axis < 3; ++axis) {
      CHANGES(def.from[axis], def.from[axis] = 0.25);
      KEEPS(def.from[axis], def.from[axis] = -0.0);
      CHANGES(def.to[axis], def.to[axis] = 8);
    }
    CHANGES(def.from_value, def.from_value = 0.75);
    CHANGES(def.to_value, def.to_value = 3);
    CHANGES(def.from_value, def.from_value = 2; def.to_value = 0.5);
  }
}

static void hash_radial(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_field* field;
  assert_ok(msq_field_radial(in, (const msq_radial_field_def*)def, &field));
  hash_and_release(field, hash);
}

static void radial_fields_hash_their_numbers(void** state) {
  msq_radial_field_def def;
  (void)state;
  assert_ok(msq_radial_field_def_init(&def, sizeof def));
  def.from_value = 0.5;
  HASHES(context, "msq_radial_field_def", &def, sizeof def, hash_radial) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.reserved);
    for (int axis = 0; axis < 3; ++axis) {
      CHANGES(def.center[axis], def.center[axis] = 1);
      CHANGES(def.axis[axis], def.axis[axis] = 2);
    }
    CHANGES(def.from_radius, def.from_radius = 0.25);
    CHANGES(def.from_value, def.from_value = 2);
    CHANGES(def.to_radius, def.to_radius = 3);
    CHANGES(def.to_value, def.to_value = 4);
  }
}

static double knots[3][2] = {{0, 1}, {0.5, 3}, {1, 2}};

typedef struct map_def {
  const msq_field* argument;
  const double* curve;
  uint64_t count;
} map_def;

static void hash_map(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const map_def* map = (const map_def*)def;
  msq_field* field;
  assert_ok(msq_field_map(in, map->argument, map->curve, map->count, &field));
  hash_and_release(field, hash);
}

static void maps_hash_argument_and_curve(void** state) {
  msq_field *one = ramp_of(context, 0, 1), *same = ramp_of(context, 0, 1),
            *other = ramp_of(context, 0, 2);
  map_def def = {one, knots[0], 3};
  (void)state;
  HASHES(context, "map", &def, sizeof def, hash_map) {
    CHANGES(def.argument, def.argument = other);
    KEEPS(def.argument, def.argument = same);
    NOT_HASHED(def.curve);
    CHANGES(def.count, def.count = 2);
    for (int i = 0; i < 3; ++i) {
      CHANGES_BEHIND(double, knots[i][0], knots[i][0] + 0.125);
      CHANGES_BEHIND(double, knots[i][1], knots[i][1] + 0.125);
    }
  }
  msq_field_release(other);
  msq_field_release(same);
  msq_field_release(one);
}

static void hash_grid(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_field* field;
  assert_ok(msq_field_grid(in, (const msq_grid_field_def*)def, &field));
  hash_and_release(field, hash);
}

static void grids_hash_the_image(void** state) {
  static double values[27], more[64];
  msq_grid_field_def def;
  (void)state;
  for (int i = 0; i < 27; ++i) {
    values[i] = i;
    more[4 * (i / 3) + i % 3] = i;
  }
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_FLOAT64;
  for (int axis = 0; axis < 3; ++axis) def.image.size[axis] = 3;
  HASHES(context, "msq_grid_field_def", &def, sizeof def, hash_grid) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.reserved);
    NOT_HASHED(def.image.values);
    NOT_HASHED(def.image.reserved);
    CHANGES(def.image.value_type, def.image.value_type = MSQ_UINT8);
    CHANGES(def.image.size[0], def.image.size[0] = 1);
    CHANGES(def.image.size[1], def.image.size[1] = 1);
    CHANGES(def.image.size[2], def.image.size[2] = 1);
    KEEPS(def.image.row_stride, def.image.values = more; def.image.row_stride = 32);
    KEEPS(def.image.layer_stride, def.image.layer_stride = 72);
    GRID_CHANGES(def.image.grid);
    for (int i = 0; i < 27; ++i) CHANGES_BEHIND(double, values[i], values[i] + 0x1p-40);
    values[0] = -0.0;
    KEEPS(def.image.values, (void)0);
  }
}

static msq_named_value named[2] = {{"a", 2}, {"unused", 5}};

static void hash_expression(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_field* field;
  assert_ok(msq_field_expression(in, (const msq_expression_field_def*)def, &field));
  hash_and_release(field, hash);
}

static msq_expression_field_def expression_def(const char* text) {
  msq_expression_field_def def;
  assert_ok(msq_expression_field_def_init(&def, sizeof def));
  def.expression = text;
  def.high = 1;
  return def;
}

static void expressions_hash_their_operations(void** state) {
  msq_expression_field_def def = expression_def("(x + a) * x");
  uint8_t hash[hash_bytes];
  (void)state;
  def.parameters = named;
  def.parameter_count = 2;
  hash_expression(context, &def, hash);
  assert_hash(hash, "e1c8020677ce94804938d6697c12f1a9");
  HASHES(context, "msq_expression_field_def", &def, sizeof def, hash_expression) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.reserved);
    NOT_HASHED(def.parameters);
    KEEPS(def.expression, def.expression = "( x+a )*x");
    KEEPS(def.expression, def.expression = "(x + 2) * x");
    KEEPS(def.expression, def.expression = "((x) + (1 + 1)) * x");
    KEEPS(def.parameter_count, def.parameter_count = 1);
    CHANGES(def.expression, def.expression = "(y + a) * x");
    CHANGES(def.expression, def.expression = "(x - a) * x");
    CHANGES(def.expression, def.expression = "(x + a) * y");
    CHANGES(def.expression, def.expression = "(x + a) / x");
    CHANGES(def.expression, def.expression = "x / (x + a)");
    CHANGES(def.expression, def.expression = "min(x, 0)");
    CHANGES(def.expression, def.expression = "max(x, 0)");
    /* 1 / -0 is not 1 / 0. */
    CHANGES(def.expression, def.expression = "max(x, -0)");
    CHANGES(def.expression, def.expression = "x + 0 / 0");
    const char* const functions[] = {"-x",
                                     "abs(x)",
                                     "sqrt(x)",
                                     "sin(x)",
                                     "cos(x)",
                                     "exp(x)",
                                     "log(x)",
                                     "tanh(x)",
                                     "floor(x)",
                                     "ceil(x)",
                                     "round(x)",
                                     "mod(x, 3)",
                                     "x < 0",
                                     "x <= 0",
                                     "x > 0",
                                     "x >= 0",
                                     "atan2(x, y)",
                                     "atan2(y, x)",
                                     "hypot(x, y)",
                                     "select(x < 0, y, z)",
                                     "select(x < 0, z, y)"};
    for (size_t f = 0; f < COUNT_OF(functions); ++f)
      CHANGES(def.expression, def.expression = functions[f]);
    CHANGES(def.low, def.low = 0.25);
    CHANGES(def.high, def.high = 2);
    CHANGES_BEHIND(double, named[0].value, 3);
    named[1].value = 6;
    KEEPS(def.parameters, (void)0);
    named[1].value = 5;
  }
}

static void hash_distance(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_field* field;
  assert_ok(msq_field_shape_distance(in, (const msq_shape_distance_field_def*)def, &field, NULL));
  hash_and_release(field, hash);
}

static void distances_hash_the_shape(void** state) {
  msq_shape *box = make_box(context), *same = make_box(context), *mesh = make_cube_mesh(context);
  msq_shape_distance_field_def def;
  (void)state;
  assert_ok(msq_shape_distance_field_def_init(&def, sizeof def));
  def.shape = box;
  def.curve = knots[0];
  def.curve_count = 3;
  for (int sampled = 0; sampled < 2; ++sampled) {
    def.step = sampled ? 1 : 0;
    HASHES(context, "msq_shape_distance_field_def", &def, sizeof def, hash_distance) {
      NOT_HASHED(def.struct_size);
      NOT_HASHED(def.reserved);
      NOT_HASHED(def.curve);
      KEEPS(def.shape, def.shape = same);
      /* Of samples only these count. */
      if (!sampled) CHANGES(def.shape, def.shape = mesh);
      CHANGES(def.curve_count, def.curve_count = 2);
      CHANGES(def.step, def.step = 0.5);
      for (int i = 0; i < 3; ++i) CHANGES_BEHIND(double, knots[i][1], knots[i][1] + 0.125);
    }
  }
  msq_shape_release(mesh);
  msq_shape_release(same);
  msq_shape_release(box);
}

static void hash_host(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_field* field;
  assert_ok(msq_field_host(in, (const msq_host_field_def*)def, &field));
  hash_and_release(field, hash);
}

static void host_fields_hash_their_key(void** state) {
  msq_host_field_def def;
  (void)state;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  def.evaluate = half;
  def.low = 0;
  def.high = 1;
  def.hash_key[0] = def.hash_key[1] = 7;
  HASHES(context, "msq_host_field_def", &def, sizeof def, hash_host) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.evaluate);
    KEEPS(def.concurrent, def.concurrent = 1);
    KEEPS(def.range, def.range = range_of_half);
    HOST_ROWS(def);
    CHANGES(def.low, def.low = -1);
    CHANGES(def.high, def.high = 2);
    CHANGES(def.lipschitz, def.lipschitz = 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradients_hash_their_numbers),
      cmocka_unit_test(radial_fields_hash_their_numbers),
      cmocka_unit_test(maps_hash_argument_and_curve),
      cmocka_unit_test(grids_hash_the_image),
      cmocka_unit_test(expressions_hash_their_operations),
      cmocka_unit_test(distances_hash_the_shape),
      cmocka_unit_test(host_fields_hash_their_key),
  };
  if (!MSQ_WITH_XXHASH) return 0;
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
