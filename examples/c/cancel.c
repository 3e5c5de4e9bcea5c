/* SPDX-License-Identifier: Apache-2.0
 * Another thread shows the progress of a long call, and cancels it half-way. */
#define _POSIX_C_SOURCE 200809L
#include <msq.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "cancel: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* The thread of a window, say. It holds a reference to the job of its own. */
static void* watch(void* argument) {
  msq_job* job = argument;
  const struct timespec pause = {0, 5000000};
  double fraction = 0, shown = 0;
  while (fraction < 0.5) {
    nanosleep(&pause, NULL);
    check(msq_job_progress(job, &fraction));
    if (fraction >= shown + 0.1) printf("%3.0f %%\n", 100 * (shown = fraction));
  }
  check(msq_job_cancel(job)); /* from any thread; the call returns within tens of milliseconds */
  msq_job_release(job);
  return NULL;
}

static int32_t count_layer(void* user, const msq_layer* layer) {
  (void)layer;
  ++*(uint64_t*)user;
  return 0;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double min[3] = {0, 0, 0}, max[3] = {100, 100, 100};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 3;
  foam_def.radius.value = 0.3;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = 0.1;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));

  msq_job* job;
  check(msq_job_create(&job));
  msq_job_retain(job); /* for the thread */
  pthread_t window;
  if (pthread_create(&window, NULL, watch, job) != 0) return 1;
  uint64_t layers = 0;
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, count_layer, &layers, job);
  pthread_join(window, NULL);
  printf("%s after %llu of 1000 layers\n", msq_status_name(status), (unsigned long long)layers);

  msq_job_release(job);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(box);
  msq_context_release(context);
  return status != MSQ_E_CANCELLED || layers == 0;
}
