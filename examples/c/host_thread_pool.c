/* SPDX-License-Identifier: Apache-2.0
 * A host with its own threads: msq shares its loops among them and starts none itself. The pool
 * lets callers do tasks of their own loop, so loops within tasks and loops of several threads at
 * once cannot wait for each other. */
#include <msq.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "host_thread_pool: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* A loop that is under way, on the stack of its caller. */
typedef struct loop {
  msq_task_fn body;
  void* task;
  uint64_t count, next, running; /* the tasks; the next to begin; those that run */
  struct loop* older;
} loop;

enum { worker_count = 3 };

typedef struct pool {
  pthread_mutex_t mutex;  /* guards all of this */
  pthread_cond_t changed; /* a loop began, the last task of one ended, or the pool ends */
  loop* newest;           /* of the loops with tasks to begin */
  int is_over, started;   /* workers */
  uint64_t tasks;         /* that a thread has begun */
  pthread_t workers[worker_count];
} pool;

/* Does one task of a loop that has some left, with the mutex held before and after. */
static void do_task(pool* p, loop* l) {
  const uint64_t i = l->next++;
  ++l->running;
  ++p->tasks;
  if (l->next == l->count) { /* the list has only loops with tasks to begin */
    loop** at = &p->newest;
    while (*at != l) at = &(*at)->older;
    *at = l->older;
  }
  pthread_mutex_unlock(&p->mutex);
  l->body(l->task, i);
  pthread_mutex_lock(&p->mutex);
  if (--l->running == 0) pthread_cond_broadcast(&p->changed);
}

static void* work(void* argument) {
  pool* p = argument;
  pthread_mutex_lock(&p->mutex);
  while (!p->is_over)
    if (p->newest)
      do_task(p, p->newest);
    else
      pthread_cond_wait(&p->changed, &p->mutex);
  pthread_mutex_unlock(&p->mutex);
  return NULL;
}

/* An msq_parallel_for_fn. */
static int32_t parallel_for(void* user, uint64_t count, msq_task_fn body, void* task) {
  pool* p = user;
  if (count == 0) return 0;
  pthread_mutex_lock(&p->mutex);
  loop own = {body, task, count, 0, 0, p->newest};
  p->newest = &own;
  pthread_cond_broadcast(&p->changed);
  while (own.next < own.count) do_task(p, &own);
  while (own.running > 0) pthread_cond_wait(&p->changed, &p->mutex);
  pthread_mutex_unlock(&p->mutex);
  return 0; /* a code of the host's own would stop the call of msq */
}

static void start_pool(pool* p) {
  while (p->started < worker_count && pthread_create(&p->workers[p->started], NULL, work, p) == 0)
    ++p->started;
}

static void end_pool(void* user) {
  pool* p = user;
  pthread_mutex_lock(&p->mutex);
  p->is_over = 1;
  pthread_cond_broadcast(&p->changed);
  pthread_mutex_unlock(&p->mutex);
  for (int i = 0; i < p->started; ++i) pthread_join(p->workers[i], NULL);
}

/* Runs on the thread that called msq_slicer_run, layer after layer, whatever thread computed. */
static int32_t add_layer(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count;
  return 0;
}

/* Pixels in the layers of a block of 20 mm filled with a foam. */
static uint64_t slice_block(const msq_context_def* context_def) {
  msq_context* context;
  check(msq_context_create(context_def, &context));
  const double min[3] = {0, 0, 0}, max[3] = {20, 20, 20};
  msq_shape* block;
  check(msq_shape_from_box(context, min, max, &block));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.value = 0.1;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));
  const msq_scale_def scales[2] = {{.shape = block}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = 0.05;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  uint64_t pixels = 0;
  check(msq_slicer_run(slicer, 0, UINT64_MAX, add_layer, &pixels, NULL));
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(block);
  msq_context_release(context);
  return pixels;
}

int main(void) {
  static pool threads = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
  start_pool(&threads);
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.threads = 1;
  const uint64_t alone = slice_block(&def); /* on this thread, for comparison */

  def.threads = worker_count + 1; /* tasks of a loop at once: the workers and the caller */
  def.parallel_for = parallel_for;
  def.parallel_for_user = &threads;
  def.parallel_for_release = end_pool; /* when the last object of the context is gone */
  const uint64_t pixels = slice_block(&def);
  printf("%llu pixels in %llu tasks, shared with %d threads of the pool; %llu without it\n",
         (unsigned long long)pixels, (unsigned long long)threads.tasks, threads.started,
         (unsigned long long)alone);
  return pixels != alone || pixels == 0 || threads.tasks == 0;
}
