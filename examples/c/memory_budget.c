/* SPDX-License-Identifier: Apache-2.0
 * Slices a foam within less and less memory. Layers stay the same; the call fails with a message,
 * and changes nothing, when the limit is too small for it. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "memory_budget: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static int32_t count_layer(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count;
  return 0;
}

/* Slices a block of 64 x 64 x 4 mm. The limit is that of all objects and calls of a context. */
static msq_status slice(uint64_t limit, uint64_t* pixels, uint64_t* peak) {
  msq_context_def context_def;
  check(msq_context_def_init(&context_def, sizeof context_def));
  context_def.memory_limit = limit; /* 0: none */
  msq_context* context;
  check(msq_context_create(&context_def, &context));
  const double min[3] = {0, 0, 0}, max[3] = {64, 64, 4};
  msq_shape* block;
  check(msq_shape_from_box(context, min, max, &block));
  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 4;
  foam_def.radius.value = 0.4;
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
  plan.resolution[0] = plan.resolution[1] = 4096; /* 2 MiB per layer */
  plan.layer_height = 0.5;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));

  *pixels = 0;
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, count_layer, pixels, NULL);
  msq_memory_report memory = {.struct_size = sizeof memory};
  check(msq_context_memory(context, &memory));
  *peak = memory.peak_bytes;
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(block);
  msq_context_release(context);
  return status;
}

int main(void) {
  uint64_t expected, peak;
  check(slice(0, &expected, &peak));
  printf("no limit: %llu pixels, %.1f MiB at most\n", (unsigned long long)expected,
         (double)peak / 1048576);
  int wrong = 0, refused = 0;
  for (uint64_t limit = 16u << 20; limit >= 1u << 20; limit /= 2) {
    uint64_t pixels;
    const msq_status status = slice(limit, &pixels, &peak);
    printf("%2llu MiB: ", (unsigned long long)(limit >> 20));
    if (status == MSQ_OK) {
      printf("%s, %.1f MiB at most\n", pixels == expected ? "the same layers" : "other layers",
             (double)peak / 1048576);
      wrong += pixels != expected || peak > limit;
    } else {
      printf("%s: %s\n", msq_status_name(status), msq_error_message());
      wrong += status != MSQ_E_LIMIT;
      ++refused;
    }
  }
  return wrong != 0 || refused == 0;
}
