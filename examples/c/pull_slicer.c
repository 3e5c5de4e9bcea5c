/* SPDX-License-Identifier: Apache-2.0
 * A slicer that asks for layers in place of being called with them: its threads take one layer
 * after the other from a counter and slice it into buffers of their own. */
#include <msq.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "pull_slicer: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

enum { thread_count = 3, layer_count = 200 };

typedef struct work {
  const msq_slicer* slicer; /* any number of threads may use it at once */
  uint64_t layer_bytes;
  pthread_mutex_t mutex; /* guards next */
  uint64_t next;
  uint64_t solid[layer_count]; /* pixels */
} work;

static uint64_t count_bits(const uint8_t* bytes, uint64_t count) {
  uint64_t bits = 0;
  for (uint64_t i = 0; i < count; ++i)
    for (unsigned byte = bytes[i]; byte; byte &= byte - 1) ++bits;
  return bits;
}

static void* slice(void* argument) {
  work* w = argument;
  uint8_t* buffer = malloc(w->layer_bytes);
  if (!buffer) exit(1);
  for (;;) {
    pthread_mutex_lock(&w->mutex);
    const uint64_t index = w->next < layer_count ? w->next++ : layer_count;
    pthread_mutex_unlock(&w->mutex);
    if (index == layer_count) break;
    /* Layers that follow one another share work, so a counter is a good order. Any is correct. */
    check(msq_slice_layer(w->slicer, index, buffer, w->layer_bytes, NULL));
    w->solid[index] = count_bits(buffer, w->layer_bytes);
  }
  free(buffer);
  return NULL;
}

static int32_t count_layer(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count;
  return 0;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 20};
  msq_shape* rod;
  check(msq_shape_from_cylinder(context, from, to, 12, &rod));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 2;
  foam_def.radius.value = 0.2;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));
  const msq_scale_def scales[2] = {{.shape = rod}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_slicer_def plan_def;
  check(msq_slicer_def_init(&plan_def, sizeof plan_def));
  plan_def.pitch[0] = plan_def.pitch[1] = 0.05;
  plan_def.layer_height = 0.1;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan_def, &slicer));
  msq_slicer_report plan = {.struct_size = sizeof plan};
  check(msq_slicer_info(slicer, &plan));

  static work w;
  w.slicer = slicer;
  w.layer_bytes = plan.layer_bytes;
  pthread_mutex_init(&w.mutex, NULL);
  pthread_t threads[thread_count];
  int started = 0;
  while (started < thread_count && pthread_create(&threads[started], NULL, slice, &w) == 0)
    ++started;
  slice(&w); /* this thread takes part, too */
  for (int i = 0; i < started; ++i) pthread_join(threads[i], NULL);
  uint64_t pulled = 0, pushed = 0;
  for (int i = 0; i < layer_count; ++i) pulled += w.solid[i];

  check(msq_slicer_run(slicer, 0, UINT64_MAX, count_layer, &pushed, NULL));
  printf("%llu pixels in %llu layers; %llu by a run\n", (unsigned long long)pulled,
         (unsigned long long)plan.layer_count, (unsigned long long)pushed);

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(rod);
  msq_context_release(context);
  return pulled != pushed || pulled == 0 || plan.layer_count != layer_count;
}
