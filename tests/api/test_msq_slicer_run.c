/* SPDX-License-Identifier: Apache-2.0
 * msq_slicer_run. Progress and cancelling: test_msq_job_*.c. Memory limit:
 * test_msq_context_memory.c. */
#include "layers.h"

static msq_context* context;
static msq_model* lattice; /* 0 to 4 in each axis, cells of 1 */

static int set_up(void** state) {
  (void)state;
  context = make_context();
  lattice = make_lattice_model(context);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(lattice);
  msq_context_release(context);
  return 0;
}

/* 70 x 45 pixels, 16 layers, 4 to the slab. */
static msq_slicer_def small_def(int32_t output) {
  return slicer_def(output, 70, 45, 0.25);
}

/* ---- the layers' bytes */

/* Layers come in order, on this thread, and hold what the points say (take_layer() sees to the
 * rest); takes over the model. */
static void check_layers(msq_model* model, msq_slicer_def def) {
  for (int32_t output = MSQ_LAYER_BITS; output <= MSQ_LAYER_BYTES; ++output) {
    def.output = output;
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack stack = run_all(slicer, output);
    assert_layers_of(&stack, model, slicer, def.length_scale, 5);
    free_stack(&stack);
    msq_slicer_release(slicer);
  }
  msq_model_release(model);
}

static void layers_hold_what_the_points_say(void** state) {
  const double middle[3] = {2, 2, 2};
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, middle, 2, &ball));
  check_layers(make_lattice_model(context), def);
  check_layers(make_shape_model(context, ball), def);
  check_layers(make_shape_model(context, make_cube_mesh(context)), def);
  check_layers(make_foam_model(context, MSQ_FOAM_DIRECT), def);
  check_layers(make_foam_model(context, MSQ_FOAM_METHOD_1), def);
#if MSQ_WITH_CGAL
  check_layers(make_foam_model(context, MSQ_FOAM_METHOD_2), def);
#endif
}

static void layers_have_any_width(void** state) {
  const uint32_t widths[] = {1, 7, 8, 9, 63, 64, 65, 130};
  (void)state;
  for (size_t i = 0; i < sizeof widths / sizeof widths[0]; ++i)
    check_layers(make_lattice_model(context), slicer_def(MSQ_LAYER_BITS, widths[i], 11, 0.5));
}

static void layers_have_any_region(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 0, 0.2);
  (void)state;
  def.pitch[1] = 0.07;
  def.has_region = 1;
  def.region_min[0] = -1.3; /* over the box's corner, and past its top */
  def.region_min[1] = 2.1;
  def.region_min[2] = 2.9;
  def.region_max[0] = 0.7;
  def.region_max[1] = 4.9;
  def.region_max[2] = 4.7;
  check_layers(make_lattice_model(context), def);
  def.region_min[0] = 100; /* past the box altogether */
  def.region_max[0] = 101;
  check_layers(make_lattice_model(context), def);
}

static void layers_have_any_heights(void** state) {
  const double heights[] = {-0.5, 0, 0.001, 0.5, 1.75, 1.7500001, 4, 4.0001, 300};
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0);
  (void)state;
  def.layer_z = heights;
  def.layer_z_count = sizeof heights / sizeof heights[0];
  check_layers(make_lattice_model(context), def);
  check_layers(make_shape_model(context, make_cube_mesh(context)), def);
}

static void finer_scales_are_solid_at_a_length_scale(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.5);
  const double scales[] = {0, 0.5, 1, 2, INFINITY};
  (void)state;
  for (int i = 0; i < 5; ++i) {
    def.length_scale = scales[i];
    check_layers(make_model(context, make_box(context),
                            make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.5),
                            make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0.5, 0.1)),
                 def);
  }
}

static void any_slab_and_threads_give_the_same_bytes(void** state) {
  const uint32_t slabs[] = {0, 1, 2, 3, 7, 15, 16, 17, UINT32_MAX};
  msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_slicer* slicer = make_slicer(lattice, &def);
  layer_stack wanted = run_all(slicer, MSQ_LAYER_BITS);
  (void)state;
  msq_slicer_release(slicer);
  for (size_t i = 0; i < sizeof slabs / sizeof slabs[0]; ++i)
    for (uint32_t threads = 1; threads <= 2; ++threads) {
      msq_context* own = make_context_of(threads, 0, 0);
      msq_model* model = make_lattice_model(own);
      def.slab_layers = slabs[i];
      slicer = make_slicer(model, &def);
      layer_stack got = run_all(slicer, MSQ_LAYER_BITS);
      assert_same_layers(&wanted, &got);
      free_stack(&got);
      msq_slicer_release(slicer);
      msq_model_release(model);
      msq_context_release(own);
    }
  free_stack(&wanted);
}

static void ranges_are_parts_of_the_whole(void** state) {
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_slicer* slicer = make_slicer(lattice, &def);
  layer_stack all = run_all(slicer, MSQ_LAYER_BITS);
  const uint64_t bytes = all.plan.layer_bytes;
  (void)state;
  for (uint64_t first = 0; first <= 16; ++first)
    for (uint64_t count = 0; count <= 16 - first; count += first % 3 + 1) {
      layer_stack part = make_stack(slicer, MSQ_LAYER_BITS, first, count);
      assert_ok(msq_slicer_run(slicer, first, count, take_layer, &part, NULL));
      assert_nothing_wrong(&part);
      assert_int_equal(part.taken, count);
      assert_memory_equal(part.data, all.data + first * bytes, count * bytes);
      free_stack(&part);
    }
  free_stack(&all);
  msq_slicer_release(slicer);
}

static void count_of_uint64_max_runs_to_the_last(void** state) {
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_slicer* slicer = make_slicer(lattice, &def);
  (void)state;
  for (uint64_t first = 0; first <= 16; first += 8) {
    layer_stack rest = make_stack(slicer, MSQ_LAYER_BITS, first, 0);
    assert_ok(msq_slicer_run(slicer, first, UINT64_MAX, take_layer, &rest, NULL));
    assert_nothing_wrong(&rest);
    assert_int_equal(rest.taken, 16 - first);
    free_stack(&rest);
  }
  msq_slicer_release(slicer);
}

/* ---- callbacks */

/* Points that a host's shape was asked for, in all and when the first layer came. */
typedef struct point_counts {
  uint64_t now, at_first;
} point_counts;

static int32_t count_points(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)points;
  ((point_counts*)user)->now += count;
  memset(inside, 1, count);
  return 0;
}

static int32_t note_first(void* user, const msq_layer* layer) {
  point_counts* counts = (point_counts*)user;
  if (layer->index == 0) counts->at_first = counts->now;
  return 0;
}

static void first_layer_waits_for_few_layers(void** state) {
  const uint64_t layers[] = {1, 33, 64, 65, 130}, slab = 64, pixels = 24;
  (void)state;
  for (int i = 0; i < 5; ++i) {
    point_counts counts = {0, 0};
    msq_host_shape_def def;
    msq_shape* shape;
    assert_ok(msq_host_shape_def_init(&def, sizeof def));
    def.inside = count_points;
    def.user = &counts;
    for (int axis = 0; axis < 3; ++axis) {
      def.min[axis] = 0;
      def.max[axis] = 4;
    }
    assert_ok(msq_shape_from_host(context, &def, &shape));
    msq_model* model = make_shape_model(context, shape);
    msq_slicer_def plan =
        slicer_def(MSQ_LAYER_BITS, (uint32_t)pixels, (uint32_t)pixels, 4.0 / (double)layers[i]);
    plan.slab_layers = (uint32_t)slab;
    msq_slicer* slicer = make_slicer(model, &plan);
    assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, note_first, &counts, NULL));
    const uint64_t layer = pixels * pixels, deep = layers[i] < slab ? layers[i] : slab;
    assert_int_equal(counts.now, layers[i] * layer);
    assert_int_equal(counts.at_first, (deep + 31) / 32 * layer);
    msq_slicer_release(slicer);
    msq_model_release(model);
  }
}

static void negative_return_stops_the_run(void** state) {
  const uint64_t stops[] = {0, 3, 4, 15};
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  (void)state;
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* own = make_context_of(threads, 0, 0);
    msq_model* model = make_lattice_model(own);
    msq_slicer* slicer = make_slicer(model, &def);
    for (int i = 0; i < 4; ++i) {
      layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
      stack.stop_at = stops[i];
      stack.stop_code = -1000 - i;
      assert_refused(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL), MSQ_E_HOST,
                     "callback");
      assert_message_has_number(1000 + (uint64_t)i);
      assert_message_has_number(stops[i]);
      assert_int_equal(msq_error_host_code(), -1000 - i);
      assert_int_equal(stack.taken, stops[i] + 1);
      assert_int_equal(memory_of(own).bytes, 0);
      free_stack(&stack);
    }
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(own);
  }
}

typedef struct nested {
  const msq_slicer* slicer;
  layer_stack outer;
  layer_stack inner;
  uint8_t* layer;
  int wrong;
} nested;

/* Asks for points, for the layer in hand once more, and for a run within the run. */
static int32_t call_again(void* user, const msq_layer* layer) {
  nested* n = (nested*)user;
  const double point[3] = {0.5, 0.5, 0.5};
  int32_t inside = 0;
  if (msq_point_membership(lattice, point, NULL, &inside) != MSQ_OK || inside != 1) n->wrong = 1;
  if (msq_slice_layer(n->slicer, layer->index, n->layer, n->outer.plan.layer_bytes, NULL) !=
          MSQ_OK ||
      memcmp(n->layer, layer->data, n->outer.plan.layer_bytes) != 0)
    n->wrong = 2;
  n->inner.taken = 0;
  n->inner.first = layer->index;
  if (msq_slicer_run(n->slicer, layer->index, UINT64_MAX, take_layer, &n->inner, NULL) != MSQ_OK ||
      memcmp(n->inner.data, layer->data, n->outer.plan.layer_bytes) != 0)
    n->wrong = 3;
  return take_layer(&n->outer, layer);
}

static void callback_may_call_msq(void** state) {
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_slicer* slicer = make_slicer(lattice, &def);
  layer_stack wanted = run_all(slicer, MSQ_LAYER_BITS);
  nested n;
  (void)state;
  n.slicer = slicer;
  n.outer = make_stack(slicer, MSQ_LAYER_BITS, 0, 16);
  n.inner = make_stack(slicer, MSQ_LAYER_BITS, 0, 16);
  n.layer = (uint8_t*)malloc(wanted.plan.layer_bytes);
  n.wrong = 0;
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, call_again, &n, NULL));
  assert_int_equal(n.wrong, 0);
  assert_nothing_wrong(&n.outer);
  assert_nothing_wrong(&n.inner);
  assert_same_layers(&wanted, &n.outer);
  free_stack(&n.outer);
  free_stack(&n.inner);
  free_stack(&wanted);
  free(n.layer);
  msq_slicer_release(slicer);
}

/* The last references to everything that a run works with. */
typedef struct last_references {
  msq_context* context;
  msq_model* model;
  msq_slicer* slicer;
  msq_job* job;
  int layers;
} last_references;

static int32_t release_all(void* user, const msq_layer* layer) {
  last_references* last = (last_references*)user;
  (void)layer;
  ++last->layers;
  msq_slicer_release(last->slicer);
  msq_model_release(last->model);
  msq_context_release(last->context);
  msq_job_release(last->job);
  last->slicer = NULL;
  last->model = NULL;
  last->context = NULL;
  last->job = NULL;
  return 0;
}

static void callback_may_release_the_last_references(void** state) {
  msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  last_references last = {make_context(), NULL, NULL, NULL, 0};
  (void)state;
  last.model = make_foam_model(last.context, MSQ_FOAM_DIRECT);
  def.slab_layers = 1; /* the next slab is in work while the callback runs */
  last.slicer = make_slicer(last.model, &def);
  assert_ok(msq_job_create(&last.job));
  assert_ok(msq_slicer_run(last.slicer, 0, UINT64_MAX, release_all, &last, last.job));
  assert_true(last.layers > 1);
  assert_null(last.slicer);
}

static int32_t return_one(void* user, const msq_layer* layer) {
  (void)layer;
  ++*(int*)user;
  return 1;
}

static void any_code_but_0_stops_the_run(void** state) {
  const msq_slicer_def def = small_def(MSQ_LAYER_BITS);
  msq_slicer* slicer = make_slicer(lattice, &def);
  int layers = 0;
  (void)state;
  assert_status(msq_slicer_run(slicer, 0, UINT64_MAX, return_one, &layers, NULL), MSQ_E_HOST);
  assert_int_equal(msq_error_host_code(), 1);
  assert_int_equal(layers, 1);
  msq_slicer_release(slicer);
}

/* ---- threads */

typedef struct runner {
  const msq_slicer* slicer;
  const layer_stack* wanted;
  int runs, wrong;
} runner;

static void* run_often(void* argument) {
  runner* r = (runner*)argument;
  layer_stack got = *r->wanted;
  got.thread = pthread_self();
  got.data = (uint8_t*)malloc(got.room * got.plan.layer_bytes);
  for (int i = 0; i < r->runs && got.data; ++i) {
    got.taken = 0;
    if (msq_slicer_run(r->slicer, 0, UINT64_MAX, take_layer, &got, NULL) != MSQ_OK || got.wrong ||
        got.taken != got.room ||
        memcmp(got.data, r->wanted->data, got.room * got.plan.layer_bytes) != 0)
      r->wrong = 1;
  }
  if (!got.data) r->wrong = 2;
  free(got.data);
  return NULL;
}

/* Two slicers of one context, and one slicer twice, each on a thread of its own. */
static void runs_go_on_at_once(void** state) {
  const msq_slicer_def bits = small_def(MSQ_LAYER_BITS), bytes = small_def(MSQ_LAYER_BYTES);
  msq_model* foam = make_foam_model(context, MSQ_FOAM_DIRECT);
  msq_slicer* slicers[2];
  layer_stack wanted[2];
  runner runners[3];
  pthread_t threads[3];
  (void)state;
  slicers[0] = make_slicer(lattice, &bits);
  slicers[1] = make_slicer(foam, &bytes);
  wanted[0] = run_all(slicers[0], MSQ_LAYER_BITS);
  wanted[1] = run_all(slicers[1], MSQ_LAYER_BYTES);
  for (int i = 0; i < 3; ++i) {
    runners[i].slicer = slicers[i % 2];
    runners[i].wanted = &wanted[i % 2];
    runners[i].runs = (int)test_count(300);
    runners[i].wrong = 0;
    assert_int_equal(pthread_create(&threads[i], NULL, run_often, &runners[i]), 0);
  }
  for (int i = 0; i < 3; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
  for (int i = 0; i < 3; ++i) assert_int_equal(runners[i].wrong, 0);
  for (int i = 0; i < 2; ++i) {
    free_stack(&wanted[i]);
    msq_slicer_release(slicers[i]);
  }
  msq_model_release(foam);
}

/* ---- what is refused */

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layers_hold_what_the_points_say),
      cmocka_unit_test(layers_have_any_width),
      cmocka_unit_test(layers_have_any_region),
      cmocka_unit_test(layers_have_any_heights),
      cmocka_unit_test(finer_scales_are_solid_at_a_length_scale),
      cmocka_unit_test(any_slab_and_threads_give_the_same_bytes),
      cmocka_unit_test(ranges_are_parts_of_the_whole),
      cmocka_unit_test(count_of_uint64_max_runs_to_the_last),
      cmocka_unit_test(first_layer_waits_for_few_layers),
      cmocka_unit_test(negative_return_stops_the_run),
      cmocka_unit_test(callback_may_call_msq),
      cmocka_unit_test(callback_may_release_the_last_references),
      cmocka_unit_test(any_code_but_0_stops_the_run),
      cmocka_unit_test(runs_go_on_at_once),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
