/* SPDX-License-Identifier: Apache-2.0
 * msq_slice_layer, one layer after the other and by several threads: layers that are filled ahead
 * have the bytes of a run, go when memory is needed, and survive calls that fail. */
#include <pthread.h>

#include "definitions.h"
#include "layers.h"

enum { side = 70, layers = 60 };

static msq_slicer* slicer_of(const msq_model* model, int32_t output, uint32_t slab_layers) {
  msq_slicer_def def = slicer_def(output, side, 52, 4.0 / layers);
  def.slab_layers = slab_layers;
  return make_slicer(model, &def);
}

/* A radius by a field, and a skin: all that is done to a slab. */
static msq_model* make_rich_model(msq_context* context) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 0};
  msq_field* field;
  msq_foam_def def;
  msq_structure* foam;
  assert_ok(msq_field_gradient(context, from, 0.05, to, 0.2, &field));
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.field = field;
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_field_release(field);
  msq_scale_def scales[3] = {{.shape = make_cube_mesh(context)},
                             {.structure = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.7)},
                             {.structure = foam, .skin = {0.2, NULL}}};
  msq_model_def model_def;
  msq_model* model;
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 3;
  assert_ok(msq_model_create(context, &model_def, &model));
  msq_shape_release((msq_shape*)scales[0].shape);
  msq_structure_release((msq_structure*)scales[1].structure);
  msq_structure_release(foam);
  return model;
}

/* Where both have points, the one above goes first. */
static msq_model* make_region_model(msq_context* context) {
  const double low[3] = {0, 1.9, 0.3}, high[3] = {4, 4, 3.1};
  msq_shape* box;
  msq_model *model, *made[2];
  assert_ok(msq_shape_from_box(context, low, high, &box));
  made[0] = make_model(context, box, make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0.7, 0.1), NULL);
  made[1] = make_rich_model(context);
  const msq_model* regions[2] = {made[0], made[1]};
  assert_ok(msq_model_regions(context, regions, 2, &model));
  for (int r = 0; r < 2; ++r) msq_model_release(made[r]);
  return model;
}

typedef struct asker {
  const msq_slicer* slicer;
  const layer_stack* wanted;
  pthread_mutex_t* mutex;
  uint64_t *next, end;
  uint64_t wrong;
} asker;

static void* ask_layers(void* argument) {
  asker* of = (asker*)argument;
  const uint64_t bytes = of->wanted->plan.layer_bytes;
  uint8_t* layer = (uint8_t*)malloc(bytes);
  for (;;) {
    pthread_mutex_lock(of->mutex);
    const uint64_t k = (*of->next)++;
    pthread_mutex_unlock(of->mutex);
    if (k >= of->end) break;
    of->wrong += msq_slice_layer(of->slicer, k, layer, bytes, NULL) != MSQ_OK ||
                 memcmp(layer, of->wanted->data + k * bytes, bytes) != 0;
  }
  free(layer);
  return NULL;
}

/* By one counter, or each thread by its own. */
static void ask_by_threads(const msq_slicer* slicer, const layer_stack* wanted, int is_by_ranges) {
  enum { count = 5 };
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_t threads[count];
  asker askers[count];
  uint64_t next[count];
  for (int t = 0; t < count; ++t) {
    const uint64_t t1 = (uint64_t)t;
    const asker of = {slicer,
                      wanted,
                      &mutex,
                      &next[is_by_ranges ? t : 0],
                      is_by_ranges ? layers * (t1 + 1) / count : layers,
                      0};
    next[t] = is_by_ranges ? layers * t1 / count : 0;
    askers[t] = of;
  }
  for (int t = 0; t < count; ++t)
    assert_int_equal(pthread_create(&threads[t], NULL, ask_layers, &askers[t]), 0);
  for (int t = 0; t < count; ++t) {
    pthread_join(threads[t], NULL);
    assert_int_equal(askers[t].wrong, 0);
  }
}

static void expect_bytes_in_any_order(msq_model* (*make)(msq_context*)) {
  const int32_t outputs[] = {MSQ_LAYER_BITS, MSQ_LAYER_GREY};
  const uint32_t threads[] = {1, 2}, slabs[] = {0, 1, 7};
  for (int t = 0; t < 2; ++t)
    for (int o = 0; o < 2; ++o)
      for (int s = 0; s < 3; ++s) {
        msq_context* context = make_context_of(threads[t], 1 << 26, 0);
        msq_model* model = make(context);
        msq_slicer* slicer = slicer_of(model, outputs[o], slabs[s]);
        layer_stack wanted = make_stack(slicer, outputs[o], 0, layers);
        assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &wanted, NULL));
        const uint64_t bytes = wanted.plan.layer_bytes;
        uint8_t* layer = (uint8_t*)malloc(bytes);
        uint64_t random = 3;
        assert_non_null(layer);
        for (int pass = 0; pass < 5; ++pass)
          for (uint64_t i = 0; i < layers; ++i) {
            const uint64_t k = pass == 0   ? i
                               : pass == 1 ? layers - 1 - i
                               : pass == 2 ? i / 2 /* each twice */
                               : pass == 3 ? i * 2 % layers
                                           : (uint64_t)random_between(&random, 0, layers);
            assert_ok(msq_slice_layer(slicer, k, layer, bytes, NULL));
            assert_memory_equal(layer, wanted.data + k * bytes, bytes);
          }
        free(layer);
        ask_by_threads(slicer, &wanted, 0);
        ask_by_threads(slicer, &wanted, 1);
        free_stack(&wanted);
        msq_slicer_release(slicer);
        msq_model_release(model);
        msq_context_release(context);
      }
}

static void any_order_has_the_bytes_of_a_run(void** state) {
  (void)state;
  expect_bytes_in_any_order(make_rich_model);
}

static void any_order_of_regions_has_the_bytes_of_a_run(void** state) {
  (void)state;
  expect_bytes_in_any_order(make_region_model);
}

/* Asks for `count` layers from `first` on. */
static void ask(const msq_slicer* slicer, uint64_t first, uint64_t count) {
  uint8_t layer[8 * 1024];
  for (uint64_t k = first; k < first + count; ++k)
    assert_ok(msq_slice_layer(slicer, k, layer, sizeof layer, NULL));
}

static void layers_ahead_take_two_slabs_and_give_way(void** state) {
  const uint64_t layer_bytes = 16 * 52; /* two words a row */
  (void)state;
  msq_context* context = make_context_of(1, 0, 1 << 20);
  msq_model* model = make_rich_model(context);
  const uint64_t before = memory_of(context).bytes;

  /* A slab of one layer: none ahead. */
  msq_slicer* slicer = slicer_of(model, MSQ_LAYER_BITS, 1);
  ask(slicer, 0, layers);
  const uint64_t built = memory_of(context).bytes; /* skins */
  msq_slicer_release(slicer);

  slicer = slicer_of(model, MSQ_LAYER_BITS, 8);
  ask(slicer, 0, 1);
  ask(slicer, 2, 1);
  assert_int_equal(memory_of(context).bytes, built); /* nothing follows */
  uint64_t most = 0;
  for (uint64_t k = 3; k < 40; ++k) {
    ask(slicer, k, 1);
    const uint64_t bytes = memory_of(context).bytes - built;
    if (bytes > most) most = bytes;
  }
  assert_true(built >= before);
  assert_in_range(most, 8 * layer_bytes, 80 * layer_bytes); /* tiles in work in it */

  /* Calls that need the memory get it. */
  ask(slicer, 40, 3);
  assert_true(memory_of(context).bytes > built);
  double corners[8][3];
  cube_corners(0, 4, corners);
  const msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
  msq_shape* shapes[8192];
  size_t count = 0;
  while (count < 8192 && msq_shape_from_mesh(context, &def, &shapes[count]) == MSQ_OK) ++count;
  assert_in_range(count, 100, 8191);
  assert_message_has("memory_limit");
  /* Where there is little room, a layer is filled by itself. */
  const uint64_t of_one = (memory_of(context).bytes - built) / count;
  for (uint64_t room = 0; room < 24 * 1024; room += of_one) msq_shape_release(shapes[--count]);
  const uint64_t held = memory_of(context).bytes;
  ask(slicer, 43, 5);
  assert_int_equal(memory_of(context).bytes, held);
  while (count > 0) msq_shape_release(shapes[--count]);
  assert_int_equal(memory_of(context).bytes, built);
  msq_slicer_release(slicer);
  assert_int_equal(memory_of(context).bytes, built);
  msq_model_release(model);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

/* A structure of the host, which fails or cancels at a call. */
typedef struct host_user {
  uint64_t calls, fail_at, points;
  msq_job* cancels;
} host_user;

static int32_t inside(void* user, const msq_host_points* points, uint8_t* result) {
  host_user* of = (host_user*)user;
  of->points += points->count;
  if (++of->calls == of->fail_at) return -9;
  if (of->cancels && of->calls == 30 && msq_job_cancel(of->cancels) != MSQ_OK) return -10;
  for (uint64_t i = 0; i < points->count; ++i) {
    const double* p = points->positions + 3 * i;
    result[i] = p[0] + p[1] * p[2] < 0.6;
  }
  return 0;
}

static msq_model* make_host_model(msq_context* context, host_user* user) {
  msq_host_structure_def def;
  msq_structure* structure;
  memset(user, 0, sizeof *user);
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = inside;
  def.user = user;
  assert_ok(msq_structure_host(context, &def, &structure));
  return make_model(context, make_box(context), structure, NULL);
}

/* Structures of the host in two regions, of which the first leaves some samples of its rows. */
static msq_model* make_host_regions(msq_context* context, host_user* user) {
  const double low[3] = {0.7, 1.2, 0}, high[3] = {4, 2.6, 4};
  msq_shape* box;
  msq_model *model, *made[2];
  msq_host_structure_def def;
  msq_structure* structure;
  made[0] = make_host_model(context, user);
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = inside;
  def.user = user;
  assert_ok(msq_structure_host(context, &def, &structure));
  assert_ok(msq_shape_from_box(context, low, high, &box));
  made[1] = make_model(context, box, structure, NULL);
  const msq_model* regions[2] = {made[1], made[0]};
  assert_ok(msq_model_regions(context, regions, 2, &model));
  for (int r = 0; r < 2; ++r) msq_model_release(made[r]);
  return model;
}

static void expect_failures_leave_the_rest(msq_model* (*make)(msq_context*, host_user*)) {
  msq_context* context = make_context_of(2, 1 << 20, 0);
  host_user user;
  msq_model* model = make(context, &user);
  msq_slicer* slicer = slicer_of(model, MSQ_LAYER_BITS, 16);
  layer_stack wanted = run_all(slicer, MSQ_LAYER_BITS);
  const uint64_t bytes = wanted.plan.layer_bytes;
  uint8_t layer[8 * 1024], untouched_layer[8 * 1024];
  memset(untouched_layer, struct_pattern, sizeof untouched_layer);
  for (uint64_t fail_at = 1; fail_at < 200; fail_at += 7) {
    uint64_t failed = 0;
    user.calls = 0;
    user.fail_at = fail_at;
    for (uint64_t k = 0; k < 40; ++k) {
      memset(layer, struct_pattern, sizeof layer);
      const msq_status status = msq_slice_layer(slicer, k, layer, bytes, NULL);
      if (status != MSQ_OK) {
        assert_int_equal(status, MSQ_E_HOST);
        assert_int_equal(msq_error_host_code(), -9);
        assert_memory_equal(layer, untouched_layer, sizeof layer);
        ++failed;
        assert_ok(msq_slice_layer(slicer, k, layer, bytes, NULL));
      }
      assert_memory_equal(layer, wanted.data + k * bytes, bytes);
    }
    assert_true(failed <= 1);
    assert_true((failed == 1) == (user.calls >= fail_at));
  }
  user.fail_at = 0;
  for (int i = 0; i < 3; ++i) {
    msq_job* job;
    uint64_t cancelled = layers;
    assert_ok(msq_job_create(&job));
    user.calls = 0;
    user.cancels = job;
    for (uint64_t k = 0; k < 40; ++k) {
      msq_status status = msq_slice_layer(slicer, k, layer, bytes, job);
      if (user.calls >= 30 && cancelled == layers) cancelled = k;
      if (k > cancelled) assert_int_equal(status, MSQ_E_CANCELLED);
      if (status == MSQ_E_CANCELLED) status = msq_slice_layer(slicer, k, layer, bytes, NULL);
      assert_int_equal(status, MSQ_OK);
      assert_memory_equal(layer, wanted.data + k * bytes, bytes);
    }
    assert_true(cancelled < layers);
    user.cancels = NULL;
    msq_job_release(job);
  }
  free_stack(&wanted);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static void failures_leave_the_rest(void** state) {
  (void)state;
  expect_failures_leave_the_rest(make_host_model);
}

static void failures_in_regions_leave_the_rest(void** state) {
  (void)state;
  expect_failures_leave_the_rest(make_host_regions);
}

/* How many points of a host's structures are evaluated, of those of the layers that are asked. */
static double points_per_layer(msq_model* (*make)(msq_context*, host_user*), uint64_t first,
                               uint64_t step, uint64_t count) {
  msq_context* context = make_context_of(1, 1 << 20, 0);
  host_user user;
  msq_model* model = make(context, &user);
  msq_slicer* slicer = slicer_of(model, MSQ_LAYER_BITS, 16);
  user.points = 0;
  for (uint64_t i = 0; i < count; ++i) ask(slicer, first + i * step, 1);
  const double points = (double)user.points / (double)(count * side * 52);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return points;
}

static void expect_little_in_vain(msq_model* (*make)(msq_context*, host_user*)) {
  assert_near(points_per_layer(make, 0, 1, layers), 1, 1e-9); /* all, once */
  assert_near(points_per_layer(make, 3, 2, 20), 1, 1e-9);     /* none follows another */
  /* The second layer begins a block of two, whose other layer nobody asks for. */
  assert_near(points_per_layer(make, 10, 1, 2), 1.5, 1e-9);
  for (uint64_t count = 3; count < 50; ++count)
    assert_true(points_per_layer(make, 5, 1, count) < 2);
}

static void little_is_filled_in_vain(void** state) {
  (void)state;
  expect_little_in_vain(make_host_model);
}

static void little_of_regions_is_filled_in_vain(void** state) {
  (void)state;
  expect_little_in_vain(make_host_regions);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_order_has_the_bytes_of_a_run),
      cmocka_unit_test(any_order_of_regions_has_the_bytes_of_a_run),
      cmocka_unit_test(layers_ahead_take_two_slabs_and_give_way),
      cmocka_unit_test(failures_leave_the_rest),
      cmocka_unit_test(failures_in_regions_leave_the_rest),
      cmocka_unit_test(little_is_filled_in_vain),
      cmocka_unit_test(little_of_regions_is_filled_in_vain),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
