/* SPDX-License-Identifier: Apache-2.0
 * msq_context_def.parallel_for: the loops of msq on threads of the host. */
#define _POSIX_C_SOURCE 200809L /* opendir, nanosleep */

#include <dirent.h>
#include <limits.h>
#include <pthread.h>
#include <time.h>

#include "cameras.h"
#include "layers.h"
#include "samples.h"
#include "struts.h"

/* ---- pools of the host ----------------------------------------------------------------------- */

/* How a pool runs the tasks of a loop. */
enum order { forwards, backwards, on_three_threads, on_another_thread, order_count };

/* The user of a parallel_for. Callbacks of several threads may change it. */
typedef struct pool {
  pthread_mutex_t mutex;
  enum order order;
  uint64_t loops, tasks, most_tasks;
  uint64_t fail_at; /* the loop to fail at, from 1; 0: none */
  int runs_first;   /* 1: a loop that fails has run its tasks before */
  uint64_t released;
  int usual_threads; /* of the process: more may be joined ones that are listed still */
  int most_threads;  /* of the process, while a loop was begun */
} pool;

static int process_threads(void) {
  DIR* tasks = opendir("/proc/self/task");
  int count = 0;
  if (!tasks) return 0;
  for (struct dirent* at = readdir(tasks); at; at = readdir(tasks)) count += at->d_name[0] != '.';
  closedir(tasks);
  return count;
}

/* A thread that was joined may be listed for a moment. */
static int process_threads_beyond(int usual) {
  const struct timespec moment = {0, 1000000};
  int count = process_threads();
  for (int i = 0; i < 2000 && count > usual; ++i) {
    nanosleep(&moment, NULL);
    count = process_threads();
  }
  return count;
}

static pool make_pool(enum order order) {
  pool made;
  memset(&made, 0, sizeof made);
  assert_int_equal(pthread_mutex_init(&made.mutex, NULL), 0);
  made.order = order;
  made.usual_threads = INT_MAX;
  return made;
}

typedef struct share {
  msq_task_fn body;
  void* task;
  uint64_t first, step, count;
} share;

static void* run_share(void* argument) {
  const share* of = (const share*)argument;
  for (uint64_t i = of->first; i < of->count; i += of->step) of->body(of->task, i);
  return NULL;
}

/* The caller does a share too, and those whose thread cannot be started. */
static void run_on_three(uint64_t count, msq_task_fn body, void* task) {
  share shares[3];
  pthread_t threads[3];
  int is_started[3] = {0, 0, 0};
  for (uint64_t s = 0; s < 3; ++s) {
    const share of = {body, task, s, 3, count};
    shares[s] = of;
    if (s > 0) is_started[s] = pthread_create(&threads[s], NULL, run_share, &shares[s]) == 0;
  }
  for (int s = 0; s < 3; ++s)
    if (!is_started[s]) run_share(&shares[s]);
  for (int s = 0; s < 3; ++s)
    if (is_started[s]) pthread_join(threads[s], NULL);
}

static int32_t run_tasks(void* user, uint64_t count, msq_task_fn body, void* task) {
  pool* of = (pool*)user;
  const int threads = process_threads_beyond(of->usual_threads);
  pthread_mutex_lock(&of->mutex);
  const int fails = ++of->loops == of->fail_at;
  of->tasks += count;
  if (count > of->most_tasks) of->most_tasks = count;
  if (threads > of->most_threads) of->most_threads = threads;
  pthread_mutex_unlock(&of->mutex);
  if (fails && !of->runs_first) return -77;
  share all = {body, task, 0, 1, count};
  pthread_t thread;
  switch (of->order) {
    case backwards:
      for (uint64_t i = count; i-- > 0;) body(task, i);
      break;
    case on_three_threads:
      run_on_three(count, body, task);
      break;
    case on_another_thread:
      if (pthread_create(&thread, NULL, run_share, &all) != 0) return -78;
      pthread_join(thread, NULL);
      break;
    default:
      run_share(&all);
  }
  return fails ? -77 : 0;
}

static void count_release(void* user) {
  ++((pool*)user)->released;
}

static msq_context_def pool_def(pool* of, uint32_t threads) {
  msq_context_def def;
  assert_ok(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  def.parallel_for = run_tasks;
  def.parallel_for_user = of;
  def.parallel_for_release = count_release;
  return def;
}

static msq_context* make_pool_context(pool* of, uint32_t threads) {
  const msq_context_def def = pool_def(of, threads);
  msq_context* context;
  assert_ok(msq_context_create(&def, &context));
  return context;
}

/* ---- all kinds of calls ---------------------------------------------------------------------- */

/* Bytes of results, one behind the other. */
typedef struct results {
  unsigned char* data;
  size_t bytes, room;
} results;

static void add(results* to, const void* data, size_t bytes) {
  if (to->bytes + bytes > to->room) {
    to->room = 2 * (to->bytes + bytes);
    to->data = (unsigned char*)realloc(to->data, to->room);
    assert_non_null(to->data);
  }
  memcpy(to->data + to->bytes, data, bytes);
  to->bytes += bytes;
}

static void ask_slicer(const msq_model* model, int32_t output, uint32_t orientation, results* to) {
  msq_slicer_def def = slicer_def(output, 190, 130, 0.1);
  def.orientation = orientation;
  def.slab_layers = 7;
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack stack = make_stack(slicer, output, 0, plan_of(slicer).layer_count);
  uint8_t* layer = (uint8_t*)malloc(stack.plan.layer_bytes);
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL));
  if (output == MSQ_LAYER_BITS) assert_nothing_wrong(&stack);
  add(to, stack.data, stack.taken * stack.plan.layer_bytes);
  assert_non_null(layer);
  assert_ok(msq_slice_layer(slicer, 3, layer, stack.plan.layer_bytes, NULL));
  add(to, layer, stack.plan.layer_bytes);
  free(layer);
  free_stack(&stack);
  msq_slicer_release(slicer);
}

enum { point_count = 20000 };

static void ask_points(const msq_model* model, results* to) {
  static double points[point_count][3], directions[point_count][3], values[point_count];
  static uint8_t inside[point_count];
  static msq_ray_hit hits[point_count];
  msq_points_def array, grid = grid_points(-0.1, 4.1, 27);
  uint64_t random = 5;
  for (int i = 0; i < point_count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      points[i][axis] = random_between(&random, -0.2, 4.2);
      directions[i][axis] = random_between(&random, -1, 1);
    }
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = point_count;
  assert_ok(msq_set_membership(model, &array, NULL, inside, sizeof inside, NULL));
  add(to, inside, sizeof inside);
  assert_ok(msq_set_membership(model, &grid, NULL, inside, 27 * 27 * 27, NULL));
  add(to, inside, 27 * 27 * 27);
  assert_ok(msq_set_distance(model, &array, NULL, values, point_count, NULL));
  add(to, values, sizeof values);

  msq_rays_def rays;
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = point_count;
  rays.origins = points;
  rays.directions = directions;
  memset(hits, 0, sizeof hits);
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, point_count, NULL));
  add(to, hits, sizeof hits);

  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_PERSPECTIVE, 60, 40);
  const msq_render_def render = render_def(60, 40);
  picture seen = rendered(model, &camera, &render);
  add(to, seen.data, seen.bytes);
  free_picture(&seen);
}

static void ask_contours(const msq_model* model, results* to) {
  msq_contours_def def;
  msq_contours* contours;
  msq_contours_report report;
  assert_ok(msq_contours_def_init(&def, sizeof def));
  def.tolerance = 0.05;
  assert_ok(msq_layer_contours(model, 1.7, &def, &contours, NULL));
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_contours_info(contours, &report));
  add(to, report.points, (size_t)report.point_count * 2 * sizeof(double));
  msq_contours_release(contours);
}

/* Enough beams that their order is found by several threads. */
static void ask_beams(msq_context* context, results* to) {
  enum { count = 70000 };
  double(*nodes)[3] = (double(*)[3])malloc(2 * count * sizeof *nodes);
  uint32_t(*beams)[2] = (uint32_t(*)[2])malloc(count * sizeof *beams);
  msq_beams_def def;
  msq_structure* structure;
  uint64_t random = 7;
  assert_non_null(nodes);
  assert_non_null(beams);
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t end = 0; end < 2; ++end) {
      for (int axis = 0; axis < 3; ++axis)
        nodes[2 * i + end][axis] = end ? nodes[2 * i][axis] + random_between(&random, -0.1, 0.1)
                                       : random_between(&random, 0, 4);
      beams[i][end] = 2 * i + end;
    }
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = nodes;
  def.node_count = 2 * count;
  def.beams = beams[0];
  def.beam_count = count;
  def.radius = 0.01;
  assert_ok(msq_structure_beams(context, &def, &structure, NULL));
  free(nodes);
  free(beams);
  msq_model* model = make_model(context, make_box(context), structure, NULL);
  ask_slicer(model, MSQ_LAYER_BITS, 0, to);
  msq_model_release(model);
}

/* Sizes, statistics and struts: what is made by loops of other rooms. */
static void ask_structure(msq_context* context, results* to) {
  msq_structure* foam = make_foam(context, MSQ_FOAM_DIRECT);
  msq_shape* box = make_cube_mesh(context);
  const double curve[] = {-1, 0.1, 0, 0.2};
  msq_shape_distance_field_def field_def;
  msq_field* field;
  assert_ok(msq_shape_distance_field_def_init(&field_def, sizeof field_def));
  field_def.shape = box;
  field_def.curve = curve;
  field_def.curve_count = 2;
  field_def.step = 0.25;
  assert_ok(msq_field_shape_distance(context, &field_def, &field, NULL));
  static double values[13 * 13 * 13];
  const msq_points_def grid = grid_points(0.2, 3.8, 13);
  assert_ok(msq_field_evaluate(context, field, &grid, values, 13 * 13 * 13, NULL));
  add(to, values, sizeof values);
  msq_field_release(field);

  msq_struts_def def = struts_def(0, 4);
  msq_strut_graph* graph;
  msq_strut_graph_report report;
  assert_ok(msq_structure_strut_graph(context, foam, &def, &graph, NULL));
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_strut_graph_info(graph, &report));
  add(to, report.nodes, (size_t)report.node_count * 3 * sizeof(double));
  msq_strut_graph_release(graph);

  msq_model* model = make_model(context, box, foam, NULL);
  const msq_points_def sample = sample_of(0, 4, 12, 9);
  msq_estimate fraction;
  memset(&fraction, 0, sizeof fraction);
  assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &fraction, NULL));
  add(to, &fraction.value, sizeof fraction.value);
  msq_model_release(model);
}

static results ask_all(msq_context* context) {
  results all = {NULL, 0, 0};
  msq_model* foam = make_foam_model(context, MSQ_FOAM_DIRECT);
  msq_model* lattice = make_model(context, make_cube_mesh(context), make_lattice(context), NULL);
  ask_slicer(foam, MSQ_LAYER_BITS, 0, &all);
  ask_slicer(foam, MSQ_LAYER_GREY, MSQ_LAYER_TRANSPOSE | MSQ_LAYER_MIRROR_X, &all);
  ask_slicer(lattice, MSQ_LAYER_DISTANCE, 0, &all);
  ask_points(foam, &all);
  ask_points(lattice, &all);
  ask_contours(foam, &all);
  ask_beams(context, &all);
  ask_structure(context, &all);
  msq_model_release(lattice);
  msq_model_release(foam);
  return all;
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void* return_at_once(void* unused) {
  return unused;
}

static void results_are_the_same_and_msq_starts_no_thread(void** state) {
  /* ThreadSanitizer has a thread of its own, from the first one of the program on. */
  pthread_t first;
  assert_int_equal(pthread_create(&first, NULL, return_at_once, NULL), 0);
  pthread_join(first, NULL);
  struct timespec while_it_ends = {0, 50000000};
  nanosleep(&while_it_ends, NULL);
  const int threads = process_threads();
  msq_context* alone = make_context_of(1, 1 << 26, 0);
  results expected = ask_all(alone);
  (void)state;
  msq_context_release(alone);
  for (int order = 0; order < order_count; ++order) {
    pool of = make_pool((enum order)order);
    of.usual_threads = threads;
    msq_context* context = make_pool_context(&of, 4);
    results got = ask_all(context);
    assert_int_equal(got.bytes, expected.bytes);
    assert_memory_equal(got.data, expected.data, got.bytes);
    free(got.data);
    assert_int_equal(of.released, 0);
    msq_context_release(context);
    assert_int_equal(of.released, 1);
    assert_true(of.loops > 50);
    assert_int_equal(of.most_tasks, 4);
    /* The pool joins its threads before it returns, and no loop is begun within another. */
    assert_int_equal(of.most_threads, threads);
    assert_int_equal(process_threads_beyond(threads), threads);
    print_message("%llu loops of %llu tasks\n", (unsigned long long)of.loops,
                  (unsigned long long)of.tasks);
  }
  free(expected.data);
}

static void tasks_are_as_many_as_threads(void** state) {
  const uint32_t threads[] = {2, 37, UINT32_MAX};
  const uint64_t most[] = {2, 37, 1024};
  const msq_points_def points = grid_points(0, 4, 40); /* 1600 rows */
  uint8_t* inside = (uint8_t*)malloc(64000);
  (void)state;
  for (int i = 0; i < 3; ++i) {
    pool of = make_pool(forwards);
    msq_context* context = make_pool_context(&of, threads[i]);
    msq_model* model = make_lattice_model(context);
    assert_ok(msq_set_membership(model, &points, NULL, inside, 64000, NULL));
    assert_int_equal(of.most_tasks, most[i]);
    msq_model_release(model);
    msq_context_release(context);
  }
  pool of = make_pool(forwards);
  msq_context* context = make_pool_context(&of, 1);
  msq_model* model = make_lattice_model(context);
  assert_ok(msq_set_membership(model, &points, NULL, inside, 64000, NULL));
  assert_int_equal(of.loops, 0);
  msq_context_release(context);
  assert_int_equal(of.released, 0); /* the model has the context */
  msq_model_release(model);
  assert_int_equal(of.released, 1);
  free(inside);
}

static void failure_of_the_host_stops_the_call(void** state) {
  (void)state;
  for (int order = 0; order < order_count; ++order)
    for (int runs_first = 0; runs_first < 2; ++runs_first)
      for (uint64_t fail_at = 1; fail_at < 7; ++fail_at) {
        pool of = make_pool((enum order)order);
        msq_context* context = make_pool_context(&of, 3);
        msq_model* model = make_foam_model(context, MSQ_FOAM_DIRECT);
        msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 80, 80, 0.05);
        def.slab_layers = 10;
        msq_slicer* slicer = make_slicer(model, &def);
        layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 80);
        of.fail_at = fail_at;
        of.runs_first = runs_first;
        assert_refused(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL), MSQ_E_HOST,
                       "parallel_for returned -77");
        assert_int_equal(msq_error_host_code(), -77);
        assert_int_equal(of.loops, fail_at); /* none after it */
        /* The next call works. */
        free_stack(&stack);
        stack = run_all(slicer, MSQ_LAYER_BITS);
        free_stack(&stack);
        msq_slicer_release(slicer);
        msq_model_release(model);
        msq_context_release(context);
      }
}

static void failure_of_the_host_leaves_the_layer(void** state) {
  static uint8_t layer[152 * 200], before[sizeof layer];
  msq_slicer_def def = slicer_def(MSQ_LAYER_GREY, 152, 200, 0.03);
  uint64_t loops = 1; /* of a call that does not fail */
  (void)state;
  def.orientation = MSQ_LAYER_MIRROR_X;
  memset(before, 0x5a, sizeof before);
  for (uint64_t fail_at = 0; fail_at <= loops; ++fail_at) {
    pool of = make_pool(forwards);
    msq_context* context = make_pool_context(&of, 3);
    msq_model* model = make_foam_model(context, MSQ_FOAM_DIRECT);
    msq_slicer* slicer = make_slicer(model, &def);
    assert_int_equal(plan_of(slicer).layer_bytes, sizeof layer);
    memcpy(layer, before, sizeof layer);
    of.fail_at = fail_at;
    of.runs_first = 1;
    if (fail_at) {
      assert_refused(msq_slice_layer(slicer, 40, layer, sizeof layer, NULL), MSQ_E_HOST,
                     "parallel_for returned -77");
      assert_memory_equal(layer, before, sizeof layer);
    } else {
      assert_ok(msq_slice_layer(slicer, 40, layer, sizeof layer, NULL));
      assert_memory_not_equal(layer, before, sizeof layer);
      loops = of.loops;
      assert_in_range(loops, 2, 100);
    }
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* A field of the host that any thread may evaluate. */
typedef struct field_user {
  pthread_mutex_t mutex;
  pthread_t caller;
  uint64_t calls, elsewhere, fail_at;
  const msq_model* asked; /* NULL: none */
  msq_job* cancels;       /* NULL: none */
} field_user;

static int32_t evaluate(void* user, const double* points, uint64_t count, double* values) {
  field_user* of = (field_user*)user;
  pthread_mutex_lock(&of->mutex);
  const uint64_t call = ++of->calls;
  of->elsewhere += !pthread_equal(of->caller, pthread_self());
  pthread_mutex_unlock(&of->mutex);
  if (call == of->fail_at) return -5;
  if (of->cancels && call == 20 && msq_job_cancel(of->cancels) != MSQ_OK) return -6;
  for (uint64_t i = 0; i < count; ++i) values[i] = 0.1 + 0.01 * points[3 * i];
  if (of->asked && call % 16 == 1) {
    uint8_t inside[11 * 11 * 11];
    msq_points_def grid;
    if (msq_points_def_init(&grid, sizeof grid) != MSQ_OK) return -7;
    grid.kind = MSQ_POINTS_GRID;
    for (int axis = 0; axis < 3; ++axis) {
      grid.spacing[axis] = 0.4;
      grid.counts[axis] = 11;
    }
    if (msq_set_membership(of->asked, &grid, NULL, inside, sizeof inside, NULL) != MSQ_OK)
      return -8;
  }
  return 0;
}

static msq_model* make_field_model(msq_context* context, field_user* user, int32_t concurrent) {
  msq_host_field_def field_def;
  msq_field* field;
  memset(user, 0, sizeof *user);
  assert_int_equal(pthread_mutex_init(&user->mutex, NULL), 0);
  user->caller = pthread_self();
  assert_ok(msq_host_field_def_init(&field_def, sizeof field_def));
  field_def.concurrent = concurrent;
  field_def.evaluate = evaluate;
  field_def.user = user;
  field_def.low = 0.1;
  field_def.high = 0.15;
  assert_ok(msq_field_host(context, &field_def, &field));
  msq_lattice_def def;
  msq_structure* lattice;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.radius.field = field;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  msq_field_release(field);
  return make_model(context, make_box(context), lattice, NULL);
}

static void callbacks_run_where_their_definition_says(void** state) {
  static uint8_t inside[20 * 20 * 20];
  const msq_points_def points = grid_points(0, 4, 20);
  (void)state;
  for (int32_t concurrent = 0; concurrent < 2; ++concurrent) {
    pool of = make_pool(on_another_thread);
    msq_context* context = make_pool_context(&of, 3);
    field_user user;
    msq_model* model = make_field_model(context, &user, concurrent);
    assert_ok(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL));
    assert_true(user.calls > 0);
    assert_true((user.elsewhere > 0) == concurrent);
    /* The failure of a callback within a task. */
    for (uint64_t fail_at = 1; fail_at < 40; fail_at += 9) {
      user.calls = 0;
      user.fail_at = fail_at;
      assert_refused(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL),
                     MSQ_E_HOST, "evaluate returned -5");
      assert_int_equal(msq_error_host_code(), -5);
    }
    msq_model_release(model);
    msq_context_release(context);
    assert_int_equal(of.released, 1);
  }
}

static void calls_within_tasks_and_at_once(void** state) {
  static uint8_t expected[20 * 20 * 20], inside[20 * 20 * 20];
  const msq_points_def points = grid_points(0, 4, 20);
  (void)state;
  for (int order = 0; order < order_count; ++order) {
    pool of = make_pool((enum order)order);
    msq_context* context = make_pool_context(&of, 3);
    field_user user;
    msq_model* other = make_foam_model(context, MSQ_FOAM_DIRECT);
    msq_model* model = make_field_model(context, &user, 1);
    assert_ok(msq_set_membership(model, &points, NULL, expected, sizeof expected, NULL));
    const uint64_t loops = of.loops;
    user.asked = other;
    assert_ok(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL));
    assert_memory_equal(inside, expected, sizeof expected);
    assert_true(of.loops > 2 * loops); /* the loops of the calls within */
    msq_model_release(model);
    msq_model_release(other);
    msq_context_release(context);
  }
}

static void cancelled_within_a_task(void** state) {
  static uint8_t inside[20 * 20 * 20];
  const msq_points_def points = grid_points(0, 4, 20);
  (void)state;
  for (int order = 0; order < order_count; ++order) {
    pool of = make_pool((enum order)order);
    msq_context* context = make_pool_context(&of, 3);
    field_user user;
    msq_job* job;
    msq_model* model = make_field_model(context, &user, 1);
    assert_ok(msq_job_create(&job));
    user.cancels = job;
    assert_status(msq_set_membership(model, &points, NULL, inside, sizeof inside, job),
                  MSQ_E_CANCELLED);
    assert_in_range(user.calls, 20, 60);
    msq_job_release(job);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void released_with_the_context_only_if_made(void** state) {
  pool of = make_pool(forwards);
  msq_context_def def = pool_def(&of, 2);
  (void)state;
  def.cache_policy = 9;
  assert_makes_nothing(msq_context, msq_context_create(&def, &made), MSQ_E_ARGUMENT,
                       "cache_policy");
  assert_int_equal(of.released, 0);
  msq_context_release(make_pool_context(&of, 2));
  assert_int_equal(of.released, 1);
  assert_int_equal(of.loops, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(results_are_the_same_and_msq_starts_no_thread),
      cmocka_unit_test(tasks_are_as_many_as_threads),
      cmocka_unit_test(failure_of_the_host_stops_the_call),
      cmocka_unit_test(failure_of_the_host_leaves_the_layer),
      cmocka_unit_test(callbacks_run_where_their_definition_says),
      cmocka_unit_test(calls_within_tasks_and_at_once),
      cmocka_unit_test(cancelled_within_a_task),
      cmocka_unit_test(released_with_the_context_only_if_made),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
