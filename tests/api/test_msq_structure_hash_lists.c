/* SPDX-License-Identifier: Apache-2.0
 * Hashes of beams and of structures that the host computes. */
#include "hashes.h"
#include "wrong_values.h"

static msq_context* context;
static msq_field *ramp, *steep_ramp;

static void hash_and_release(msq_structure* structure, uint8_t hash[hash_bytes]) {
  assert_ok(msq_structure_hash(structure, hash));
  msq_structure_release(structure);
}

/* ---- beams ----------------------------------------------------------------------------------- */

static void hash_beams(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_beams(in, (const msq_beams_def*)def, &structure, NULL));
  hash_and_release(structure, hash);
}

static double nodes[4][3] = {{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {0, 0, 6}};
static uint32_t beams[3][2] = {{0, 1}, {0, 2}, {2, 3}};
static double radii[3][2] = {{0.5, 0.5}, {0.25, 0.75}, {0.5, 0.25}}, ball_radii[2] = {1, 2};
static uint8_t caps[3][2] = {{0, 1}, {2, 0}, {1, 1}};
static uint32_t balls[2] = {3, 1};

static void beams_hash_their_list(void** state) {
  static float single[4][3];
  static const float single_radii[3][2] = {{0.5f, 0.5f}, {0.25f, 0.75f}, {0.5f, 0.25f}},
                     single_balls[2] = {1, 2};
  static double spread[4][4], spread_radii[3][3], spread_balls[2][2];
  static uint32_t spread_beams[3][3], spread_ball[2][2];
  static uint8_t spread_caps[3][4];
  msq_beams_def def;
  (void)state;
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis) spread[i][axis] = single[i][axis] = (float)nodes[i][axis];
  for (int i = 0; i < 3; ++i)
    for (int end = 0; end < 2; ++end) {
      spread_beams[i][end] = beams[i][end];
      spread_radii[i][end] = radii[i][end];
      spread_caps[i][end] = caps[i][end];
    }
  for (int i = 0; i < 2; ++i) {
    spread_ball[i][0] = balls[i];
    spread_balls[i][0] = ball_radii[i];
  }
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = nodes;
  def.node_count = 4;
  def.beams = beams[0];
  def.beam_count = 3;
  def.radii = radii;
  def.caps = caps[0];
  def.balls = balls;
  def.ball_count = 2;
  def.ball_radii = ball_radii;
  def.length_scale = 10;
  HASHES(context, "msq_beams_def", &def, sizeof def, hash_beams) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.reserved);
    NOT_HASHED(def.nodes);
    NOT_HASHED(def.beams);
    NOT_HASHED(def.balls);
    NOT_HASHED(def.node_count);
    KEEPS(def.cap, def.cap = MSQ_CAP_BUTT); /* caps are given */
    CHANGES(def.cap, def.caps = NULL; def.cap = MSQ_CAP_BUTT);
    CHANGES(def.caps, def.caps = NULL);
    KEEPS(def.coordinate_type, def.coordinate_type = MSQ_FLOAT32; def.nodes = single;
          def.radii = single_radii; def.ball_radii = single_balls);
    KEEPS(def.node_stride, def.nodes = spread; def.node_stride = sizeof spread[0]);
    KEEPS(def.beam_stride, def.beams = spread_beams[0]; def.beam_stride = sizeof spread_beams[0]);
    KEEPS(def.radius_stride, def.radii = spread_radii; def.radius_stride = sizeof spread_radii[0]);
    KEEPS(def.cap_stride, def.caps = spread_caps[0]; def.cap_stride = sizeof spread_caps[0]);
    KEEPS(def.ball_stride, def.balls = spread_ball[0]; def.ball_stride = sizeof spread_ball[0]);
    KEEPS(def.ball_radius_stride, def.ball_radii = spread_balls;
          def.ball_radius_stride = sizeof spread_balls[0]);
    CHANGES(def.beam_count, def.beam_count = 2);
    CHANGES(def.ball_count, def.ball_count = 1);
    CHANGES(def.radii, def.radii = NULL; def.radius = 0.5);
    CHANGES(def.radius, def.radii = NULL; def.radius = 0.25);
    CHANGES(def.ball_radii, def.ball_radii = NULL; def.ball_radius = 1);
    CHANGES(def.ball_radius, def.ball_radii = NULL; def.ball_radius = 2);
    CHANGES(def.min_length, def.min_length = 4.5);
    KEEPS(def.min_length, def.min_length = 3);
    CHANGES(def.length_scale, def.length_scale = 20);
    for (int i = 0; i < 4; ++i)
      for (int axis = 0; axis < 3; ++axis)
        CHANGES_BEHIND(double, nodes[i][axis], nodes[i][axis] + 0x1p-30);
    for (int i = 0; i < 3; ++i)
      for (int end = 0; end < 2; ++end) {
        CHANGES_BEHIND(double, radii[i][end], radii[i][end] + 0x1p-30);
        CHANGES_BEHIND(uint8_t, caps[i][end], (uint8_t)((caps[i][end] + 1) % 3));
      }
    CHANGES_BEHIND(uint32_t, beams[2][0], 1);
    CHANGES_BEHIND(uint32_t, balls[0], 2);
    CHANGES_BEHIND(double, ball_radii[0], 1.5);
  }
}

static void beams_have_one_hash_on_any_number_of_threads(void** state) {
  enum { many = 20000 };
  static double ends[many][3];
  static uint32_t chain[many - 1][2];
  msq_context *one = make_context_of(1, 0, 0), *four = make_context_of(4, 0, 0);
  uint64_t random = 3;
  uint8_t hash[hash_bytes], other[hash_bytes];
  msq_beams_def def;
  (void)state;
  for (int i = 0; i < many; ++i)
    for (int axis = 0; axis < 3; ++axis) ends[i][axis] = random_between(&random, -5, 5);
  for (uint32_t i = 0; i + 1 < many; ++i) {
    chain[i][0] = i;
    chain[i][1] = i + 1;
  }
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = ends;
  def.node_count = many;
  def.beams = chain[0];
  def.beam_count = many - 1;
  def.radius = 0.125;
  hash_beams(one, &def, hash);
  hash_beams(four, &def, other);
  assert_memory_equal(hash, other, hash_bytes);
  /* The order of beams is part of their ids. */
  chain[0][0] = 1;
  chain[0][1] = 0;
  hash_beams(one, &def, other);
  assert_memory_not_equal(hash, other, hash_bytes);
  msq_context_release(four);
  msq_context_release(one);
}

/* ---- structures of the host ------------------------------------------------------------------ */

static int32_t none_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static int32_t no_distance(void* user, const msq_host_points* points, double* distances) {
  (void)user;
  for (uint64_t i = 0; i < points->count; ++i) distances[i] = 0;
  return 0;
}

static int32_t build_nothing(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  (void)user;
  (void)cell;
  *data = NULL;
  *bytes = 0;
  return 0;
}

static int32_t none_in_cell(void* user, const void* data, const msq_host_points* points,
                            uint8_t* inside) {
  (void)data;
  return none_inside(user, points, inside);
}

static void free_nothing(void* user, void* data) {
  (void)user;
  (void)data;
}

static int32_t empty_box(void* user, const double min[3], const double max[3], int32_t* answer) {
  (void)user;
  (void)min;
  (void)max;
  *answer = MSQ_BOX_OUTSIDE;
  return 0;
}

static void hash_host(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_host(in, (const msq_host_structure_def*)def, &structure));
  hash_and_release(structure, hash);
}

static void host_structures_hash_their_key(void** state) {
  msq_host_structure_def def;
  (void)state;
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = none_inside;
  def.hash_key[0] = def.hash_key[1] = 7;
  HASHES(context, "msq_host_structure_def", &def, sizeof def, hash_host) {
    NOT_HASHED(def.struct_size);
    KEEPS(def.concurrent, def.concurrent = 1);
    GRID_CHANGES(def.grid);
    NOT_HASHED(def.inside);
    KEEPS(def.build_cell, def.build_cell = build_nothing; def.evaluate_cell = none_in_cell);
    NOT_HASHED(def.evaluate_cell);
    KEEPS(def.free_cell, def.build_cell = build_nothing; def.evaluate_cell = none_in_cell;
          def.free_cell = free_nothing);
    KEEPS(def.box, def.box = empty_box);
    CHANGES(def.distance, def.distance = no_distance);
    HOST_ROWS(def);
  }
}

static void hash_function(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_host_function(in, (const msq_host_function_def*)def, &structure));
  hash_and_release(structure, hash);
}

static void host_functions_hash_their_key(void** state) {
  msq_host_function_def def;
  (void)state;
  assert_ok(msq_host_function_def_init(&def, sizeof def));
  def.evaluate = half;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.25;
  def.hash_key[0] = def.hash_key[1] = 7;
  HASHES(context, "msq_host_function_def", &def, sizeof def, hash_function) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.evaluate);
    KEEPS(def.concurrent, def.concurrent = 1);
    CHANGES(def.kind, def.kind = MSQ_FUNCTIONAL_NETWORK);
    KEEPS(def.clusters, def.clusters = 4);
    GRID_CHANGES(def.grid);
    CHANGES(def.level.value, def.level.value = 0.5);
    PARAM_CHANGES(def.level, ramp, steep_ramp);
    KEEPS(def.range, def.range = range_of_half);
    HOST_ROWS(def);
    CHANGES(def.lipschitz, def.lipschitz = 1);
  }
}

/* ---- booleans -------------------------------------------------------------------------------- */

typedef struct boolean_def {
  const msq_structure* structures[2];
  int32_t operation, count;
} boolean_def;

static void hash_boolean(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const boolean_def* of = (const boolean_def*)def;
  msq_structure* structure;
  (void)in;
  assert_ok(msq_structure_boolean(of->operation, of->structures, (uint64_t)of->count, &structure));
  hash_and_release(structure, hash);
}

static void booleans_hash_their_members(void** state) {
  msq_structure* thin = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  msq_structure* thick = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.2);
  msq_structure* same = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  boolean_def def = {{thin, thick}, MSQ_BOOLEAN_UNION, 2};
  (void)state;
  HASHES(context, "msq_structure_boolean", &def, sizeof def, hash_boolean) {
    CHANGES(def.structures[0], def.structures[0] = thick);
    CHANGES(def.structures[1], def.structures[1] = thin);
    KEEPS(def.structures[0], def.structures[0] = same);
    CHANGES(def.structures, def.structures[0] = thick; def.structures[1] = thin);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_INTERSECTION);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_DIFFERENCE);
    CHANGES(def.count, def.count = 1);
  }
  msq_structure_release(same);
  msq_structure_release(thick);
  msq_structure_release(thin);
}

typedef struct blend_def {
  const msq_structure *a, *b;
  msq_param fraction;
} blend_def;

static void hash_blend(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const blend_def* of = (const blend_def*)def;
  msq_structure* structure;
  (void)in;
  assert_ok(msq_structure_blend(of->a, of->b, &of->fraction, &structure));
  hash_and_release(structure, hash);
}

static void blends_hash_their_fraction(void** state) {
  msq_structure* thin = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  msq_structure* thick = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.2);
  msq_structure* same = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  blend_def def = {thin, thick, {0.25, NULL}};
  (void)state;
  HASHES(context, "msq_structure_blend", &def, sizeof def, hash_blend) {
    CHANGES(def.a, def.a = thick);
    CHANGES(def.b, def.b = thin);
    KEEPS(def.a, def.a = same);
    CHANGES(def.a, def.a = thick; def.b = thin);
    CHANGES(def.fraction.value, def.fraction.value = 0.5);
    PARAM_CHANGES(def.fraction, ramp, steep_ramp);
  }
  msq_structure_release(same);
  msq_structure_release(thick);
  msq_structure_release(thin);
}

typedef struct smooth_def {
  const msq_structure *a, *b;
  msq_param radius;
  int64_t operation; /* as wide as its neighbours: no byte is without a name */
} smooth_def;

static void hash_smooth(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const smooth_def* of = (const smooth_def*)def;
  msq_structure* structure;
  (void)in;
  assert_ok(
      msq_structure_smooth_boolean((int32_t)of->operation, of->a, of->b, &of->radius, &structure));
  hash_and_release(structure, hash);
}

static void smooth_booleans_hash_their_radius(void** state) {
  msq_structure* thin = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  msq_structure* thick = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.2);
  msq_structure* same = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
  smooth_def def = {thin, thick, {0.25, NULL}, MSQ_BOOLEAN_UNION};
  (void)state;
  HASHES(context, "msq_structure_smooth_boolean", &def, sizeof def, hash_smooth) {
    CHANGES(def.a, def.a = thick);
    CHANGES(def.b, def.b = thin);
    KEEPS(def.a, def.a = same);
    CHANGES(def.a, def.a = thick; def.b = thin);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_INTERSECTION);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_DIFFERENCE);
    CHANGES(def.radius.value, def.radius.value = 0.5);
    PARAM_CHANGES(def.radius, ramp, steep_ramp);
  }
  msq_structure_release(same);
  msq_structure_release(thick);
  msq_structure_release(thin);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(beams_hash_their_list),
      cmocka_unit_test(beams_have_one_hash_on_any_number_of_threads),
      cmocka_unit_test(host_structures_hash_their_key),
      cmocka_unit_test(host_functions_hash_their_key),
      cmocka_unit_test(booleans_hash_their_members),
      cmocka_unit_test(blends_hash_their_fraction),
      cmocka_unit_test(smooth_booleans_hash_their_radius),
  };
  if (!MSQ_WITH_XXHASH) return 0;
  context = make_context();
  ramp = ramp_of(context, 0, 0.5);
  steep_ramp = ramp_of(context, 0.125, 1);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_field_release(steep_ramp);
  msq_field_release(ramp);
  msq_context_release(context);
  return failed;
}
