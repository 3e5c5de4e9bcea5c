/* SPDX-License-Identifier: Apache-2.0
 * Whatever floating-point environment a host has, msq computes the same, gives it back as it was,
 * and runs the host's callbacks in it. A trap that msq springs kills this program. */
#include "hosts.h"

#include "float_questions.h"

/* ---- every call
 * -------------------------------------------------------------------------------------- */

static msq_material* make_one_material(msq_context* context, msq_field* field) {
  msq_material *a = NULL, *b = NULL, *blend = NULL;
  msq_channel channel = {"density", {1.7, NULL}};
  msq_material_def def;
  const msq_param fraction = {0.31, NULL};
  CALL(msq_material_def_init(&def, sizeof def));
  def.id = 3;
  def.channels = &channel;
  def.channel_count = 1;
  CALL(msq_material_create(context, &def, &a));
  channel.value.field = field;
  CALL(msq_material_create(context, &def, &b));
  CALL(msq_material_blend(context, 9, a, b, &fraction, &blend));
  IN_STATE(msq_material_release(a));
  IN_STATE(msq_material_release(b));
  return blend;
}

/* Everything of one structure in one shape. */
static void ask_all(uint32_t threads, enum kind kind, int of_shape, int of_field) {
  msq_context_def def;
  msq_context* context = NULL;
  msq_field* field = NULL;
  msq_structure* structure = NULL;
  msq_shape* shape = NULL;
  msq_shape_report shape_report;
  msq_model_def model_def;
  msq_model* model = NULL;
  msq_scale_def scales[2];
  double low[3] = {0}, high[3] = {0}, length = 0;
  uint64_t pairs = 0;
  CALL(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  CALL(msq_context_create(&def, &context));
  CALL(make_field(context, of_field, &field));
  if (kind != nothing) CALL(make_structure(context, kind, field, &structure));
  CALL(make_shape(context, of_shape, &shape));
  memset(&shape_report, 0, sizeof shape_report);
  shape_report.struct_size = sizeof shape_report;
  CALL(msq_shape_info(shape, &shape_report));
  NOTE(shape_report);
  CALL(msq_shape_self_intersections(shape, &pairs, NULL));
  NOTE(pairs);
  msq_material* material = make_one_material(context, field);
  memset(scales, 0, sizeof scales);
  scales[0].shape = shape;
  scales[0].material = material;
  scales[1].structure = structure;
  if (of_field == 1) scales[1].skin.value = 0.07;
  CALL(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = kind == nothing ? 1 : 2;
  model_def.scale_size = sizeof scales[0];
  CALL(msq_model_create(context, &model_def, &model));
  IN_STATE(msq_shape_release(shape));
  IN_STATE(msq_field_release(field));
  IN_STATE(msq_material_release(material));
  CALL(msq_model_bounds(model, low, high));
  CALL(msq_model_scale_length(model, kind != nothing, &length));
  NOTE(low), NOTE(high), NOTE(length);
  ask_points(model);
  ask_statistics(context, model, structure);
  ask_layers(model);
  ask_rays(model);
  if (kind == mixed) {
    msq_lattice_faces_report faces;
    memset(&faces, 0, sizeof faces);
    faces.struct_size = sizeof faces;
    CALL(msq_lattice_faces(structure, low, high, &faces, NULL));
    NOTE(faces);
  }
  CALL(msq_cache_clear(context));
  IN_STATE(msq_structure_release(structure));
  IN_STATE(msq_model_release(model));
  IN_STATE(msq_context_release(context));
  assert_right_states();
}

/* The answers of all environments are those of the first. */
static void compare_states(uint32_t threads, enum kind kind, int of_shape, int of_field) {
  host_thread = pthread_self();
  /* The paper's method takes its time, and so do slow builds. */
  const int step = kind == foam_point ? state_count - 1 : test_scale() < 1 ? 4 : 1;
  for (host_state = 0; host_state < state_count; host_state += step) {
    is_other = host_state > 0;
    answer_bytes[is_other] = 0;
    ask_all(threads, kind, of_shape, of_field);
    if (!is_other) continue;
    assert_int_equal(answer_bytes[1], answer_bytes[0]);
    if (memcmp(answers[0], answers[1], answer_bytes[0]) != 0)
      fail_msg("structure %d, shape %d, field %d: another answer in environment \"%s\"", (int)kind,
               of_shape, of_field, state_names[host_state]);
  }
}

static void test_structures(void** state) {
  (void)state;
  for (int kind = 0; kind < kinds; ++kind)
    for (uint32_t threads = 1; threads <= 2; ++threads)
      compare_states(threads, (enum kind)kind, 0, kind % 7);
}

static void test_shapes_and_fields(void** state) {
  (void)state;
  for (int of = 0; of < 7; ++of) {
    compare_states(2, foam_of_field, of, of);
    compare_states(1, gyroid, of, (of + 3) % 7);
  }
}

/* ---- failures
 * ------------------------------------------------------------------------------------------ */

static void test_failures(void** state) {
  (void)state;
  host_thread = pthread_self();
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, 1 << 20, 0);
    msq_field* field;
    msq_structure* structure;
    host_state = 0;
    notes_messages = threads == 1;
    assert_ok(make_field(context, 3, &field));
    assert_ok(make_structure(context, foam_of_field, field, &structure));
    msq_model* model = make_model(context, make_box(context), structure, NULL);
    msq_field_release(field);
    for (host_state = 0; host_state < state_count; ++host_state) {
      const double center[3] = {0, 0, 0.1};
      msq_shape* shape = NULL;
      msq_job* job;
      is_other = host_state > 0;
      answer_bytes[is_other] = 0;
      /* The message has numbers. */
      CALL(msq_shape_from_sphere(context, center, -0.1, &shape));
      callback_code = -77;
      ask_points(model);
      ask_layers(model);
      ask_rays(model);
      callback_code = 0;
      assert_int_equal(msq_error_host_code(), -77);
      static uint8_t inside[side * side * side];
      const msq_points_def grid = grid_points(0.01, 1.98, side);
      assert_ok(msq_job_create(&job));
      CALL(msq_job_cancel(job));
      CALL(msq_set_membership(model, &grid, NULL, inside, sizeof inside, job));
      IN_STATE(msq_job_release(job));
      assert_right_states();
      if (is_other) {
        assert_int_equal(answer_bytes[1], answer_bytes[0]);
        assert_memory_equal(answers[0], answers[1], answer_bytes[0]);
      }
    }
    host_state = 0;
    msq_model_release(model);
    msq_context_release(context);
  }
  notes_messages = 1;
}

/* ---- callbacks on other threads
 * ------------------------------------------------------------------------ */

static int32_t slow_values(void* user, const double* points_, uint64_t count, double* values) {
  const struct timespec pause = {0, 100000};
  nanosleep(&pause, NULL);
  return host_values(user, points_, count, values);
}

static void test_threads(void** state) {
  (void)state;
  host_thread = pthread_self();
  for (host_state = 0; host_state < state_count; ++host_state) {
    msq_host_field_def def;
    msq_field* field;
    msq_structure* structure;
    static uint8_t inside[points];
    static double coordinates[points][3];
    uint64_t random = 1;
    msq_points_def array;
    msq_context* context = make_context_of(4, 1 << 20, 0);
    assert_ok(msq_host_field_def_init(&def, sizeof def));
    def.concurrent = 1;
    def.evaluate = slow_values;
    def.low = 0.15;
    def.high = 0.2;
    assert_ok(msq_field_host(context, &def, &field));
    assert_ok(make_structure(context, gyroid, field, &structure));
    msq_field_release(field);
    msq_model* model = make_model(context, make_box(context), structure, NULL);
    for (int i = 0; i < points; ++i)
      for (int axis = 0; axis < 3; ++axis) coordinates[i][axis] = random_between(&random, 0, 2);
    assert_ok(msq_points_def_init(&array, sizeof array));
    array.coordinates = coordinates;
    array.count = points;
    was_elsewhere = 0;
    for (int i = 0; i < 200 && !was_elsewhere; ++i) {
      is_other = 0;
      answer_bytes[0] = 0;
      ask_layers(model);
      CALL(msq_set_membership(model, &array, NULL, inside, points, NULL));
    }
    assert_right_states();
    msq_model_release(model);
    msq_context_release(context);
  }
  /* With one core there is no other thread. */
  if (!was_elsewhere) print_message("no callback ran on another thread\n");
}

/* ---- what callbacks do
 * ----------------------------------------------------------------------------------- */

typedef struct nested {
  const msq_model* model;
  int32_t inside;
  int is_wrong;
} nested;

static int32_t ask_within(void* user, const msq_layer* layer) {
  static const double point[3] = {1.37, 1.41, 1.9};
  nested* const of = (nested*)user;
  const float_state before = read_state();
  (void)layer;
  if (msq_point_membership(of->model, point, NULL, &of->inside) != MSQ_OK) of->is_wrong = 1;
  const float_state after = read_state();
  if (before.control != after.control || before.flags != after.flags) of->is_wrong = 1;
  return 0;
}

static int32_t round_down(void* user, const msq_layer* layer) {
  int* const calls = (int*)user;
  (void)layer;
  /* As the last call left it. */
  if ((*calls)++ > 0 && (fegetround() != FE_DOWNWARD || !fetestexcept(FE_OVERFLOW))) *calls = -1000;
  fesetround(FE_DOWNWARD);
  feraiseexcept(FE_OVERFLOW);
  return 0;
}

static void test_callbacks(void** state) {
  (void)state;
  host_state = 0;
  msq_context* context = make_context();
  msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 1);
  msq_slicer* slicer = make_slicer(model, &def);
  for (host_state = 0; host_state < state_count; ++host_state) {
    nested of = {model, -1, 0};
    IN_STATE(msq_slicer_run(slicer, 0, UINT64_MAX, ask_within, &of, NULL));
    assert_right_states();
    assert_false(of.is_wrong);
    assert_int_equal(of.inside, is_inside(model, 1.37, 1.41, 1.9));
  }
  /* What a callback changes is as if the host had changed it between calls. */
  int calls = 0;
  feclearexcept(FE_ALL_EXCEPT);
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, round_down, &calls, NULL);
  const int rounding = fegetround(), raised = fetestexcept(FE_ALL_EXCEPT);
  fesetenv(FE_DFL_ENV);
  assert_int_equal(status, MSQ_OK);
  assert_int_equal(calls, 4);
  assert_int_equal(rounding, FE_DOWNWARD);
  assert_int_equal(raised & FE_OVERFLOW, FE_OVERFLOW);
  assert_int_equal(raised & (FE_INVALID | FE_DIVBYZERO), 0);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

/* Definitions, versions and reports. */
static void test_small_calls(void** state) {
  (void)state;
  for (host_state = 0; host_state < state_count; ++host_state) {
    msq_build_report build;
    msq_unit_cell_def cell;
    msq_unit_cell_report report;
    double nodes[9][3];
    uint32_t struts[8][2];
    msq_context* context = make_context_of(1, 1 << 20, 0);
    msq_memory_report memory;
    msq_cache_report cache;
    msq_job* job;
    msq_job_report counts;
    msq_query_def query;
    double progress;
    is_other = host_state > 0;
    answer_bytes[is_other] = 0;
    memset(&build, 0, sizeof build);
    build.struct_size = sizeof build;
    CALL(msq_build_info(&build));
    CALL(msq_unit_cell_def_init(&cell, sizeof cell));
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    CALL(msq_unit_cell_info(&cell, &report, NULL, 0));
    NOTE(report);
    CALL(msq_unit_cell_geometry(&cell, nodes[0], 9, struts[0], 8));
    NOTE(nodes);
    memset(&memory, 0, sizeof memory);
    memory.struct_size = sizeof memory;
    CALL(msq_context_memory(context, &memory));
    memset(&cache, 0, sizeof cache);
    cache.struct_size = sizeof cache;
    CALL(msq_cache_stats(context, &cache));
    CALL(msq_query_def_init(&query, sizeof query));
    CALL(msq_job_create(&job));
    CALL(msq_job_progress(job, &progress));
    memset(&counts, 0, sizeof counts);
    counts.struct_size = sizeof counts;
    CALL(msq_job_info(job, &counts));
    IN_STATE(msq_job_retain(job));
    IN_STATE(msq_job_release(job));
    IN_STATE(msq_job_release(job));
    IN_STATE(msq_context_retain(context));
    IN_STATE(msq_context_release(context));
    IN_STATE(msq_context_release(context));
    IN_STATE((void)msq_version());
    IN_STATE((void)msq_status_name(MSQ_E_HOST));
    IN_STATE((void)msq_error_message());
    IN_STATE((void)msq_error_host_code());
    assert_right_states();
    assert_memory_equal(answers[0], answers[is_other], answer_bytes[0]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_small_calls),       cmocka_unit_test(test_structures),
      cmocka_unit_test(test_shapes_and_fields), cmocka_unit_test(test_failures),
      cmocka_unit_test(test_threads),           cmocka_unit_test(test_callbacks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
