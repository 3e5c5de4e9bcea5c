/* SPDX-License-Identifier: Apache-2.0
 * Layers as msq_slicer_run hands them out, and as they ought to be. */
#ifndef LAYERS_H
#define LAYERS_H

#include <pthread.h>

#include "fixtures.h"

/* What take_layer() keeps. It runs inside msq, so it asserts nothing and notes what is wrong. */
typedef struct layer_stack {
  msq_slicer_report plan;
  pthread_t thread; /* that made the call */
  int32_t output;
  uint64_t first; /* index of the layer to come first */
  uint64_t room;  /* layers that data holds; 0: keep none */
  uint8_t* data;
  uint64_t taken;
  uint64_t stop_at;  /* layer index to stop at */
  int32_t stop_code; /* 0: never */
  const char* wrong; /* the first thing that was */
} layer_stack;

static inline uint64_t count_bits(const uint8_t* data, uint64_t bytes) {
  uint64_t count = 0;
  for (uint64_t i = 0; i < bytes; ++i)
    for (unsigned rest = data[i]; rest; rest &= rest - 1) ++count;
  return count;
}

/* Whether the bits (or bytes) past the width are 0. */
static inline int is_padding_clear(const uint8_t* row, int32_t output, uint64_t width,
                                   uint64_t stride) {
  const uint64_t bits = output == MSQ_LAYER_BITS ? 1 : 8;
  for (uint64_t i = width * bits; i < stride * 8; ++i)
    if (row[i / 8] & (0x80u >> i % 8)) return 0;
  return 1;
}

static inline const char* layer_fault(const layer_stack* stack, const msq_layer* layer) {
  const msq_slicer_report* plan = &stack->plan;
  uint64_t inside;
  if (layer->struct_size != sizeof *layer) return "struct_size";
  if (!pthread_equal(pthread_self(), stack->thread)) return "thread";
  if (layer->index != stack->first + stack->taken) return "index";
  if (layer->output != stack->output) return "output";
  if (layer->width != plan->width || layer->height != plan->height) return "width, height";
  if (layer->stride != plan->stride || layer->stride % 8 != 0) return "stride";
  inside = count_bits(layer->data, plan->layer_bytes);
  if (layer->output == MSQ_LAYER_BYTES) inside /= 8;
  if (layer->inside_count != inside) return "inside_count";
  for (uint32_t j = 0; j < layer->height; ++j)
    if (!is_padding_clear(layer->data + j * layer->stride, layer->output, layer->width,
                          layer->stride))
      return "bits past the width";
  return NULL;
}

static inline int32_t take_layer(void* user, const msq_layer* layer) {
  layer_stack* stack = (layer_stack*)user;
  if (!stack->wrong) stack->wrong = layer_fault(stack, layer);
  if (stack->taken < stack->room)
    memcpy(stack->data + stack->taken * stack->plan.layer_bytes, layer->data,
           stack->plan.layer_bytes);
  ++stack->taken;
  return stack->stop_code && layer->index == stack->stop_at ? stack->stop_code : 0;
}

/* Ready to take `room` layers from `first` on. Free with free_stack(). */
static inline layer_stack make_stack(const msq_slicer* slicer, int32_t output, uint64_t first,
                                     uint64_t room) {
  layer_stack stack;
  memset(&stack, 0, sizeof stack);
  stack.plan = plan_of(slicer);
  stack.thread = pthread_self();
  stack.output = output;
  stack.first = first;
  stack.room = room;
  stack.data = (uint8_t*)malloc(room * stack.plan.layer_bytes + 1);
  assert_non_null(stack.data);
  return stack;
}

static inline void free_stack(layer_stack* stack) {
  free(stack->data);
}

static inline void assert_nothing_wrong(const layer_stack* stack) {
  if (stack->wrong) fail_msg("a layer's %s", stack->wrong);
}

/* All layers of a slicer. */
static inline layer_stack run_all(const msq_slicer* slicer, int32_t output) {
  const uint64_t count = plan_of(slicer).layer_count;
  layer_stack stack = make_stack(slicer, output, 0, count);
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL));
  assert_nothing_wrong(&stack);
  assert_int_equal(stack.taken, count);
  return stack;
}

/* Layer `index` asked point by point; layer_bytes bytes. */
static inline void expect_layer(const msq_model* model, const msq_slicer* slicer, int32_t output,
                                double length_scale, uint64_t index, uint8_t* data) {
  const msq_slicer_report plan = plan_of(slicer);
  msq_query_def query;
  double z;
  assert_ok(msq_query_def_init(&query, sizeof query));
  query.length_scale = length_scale;
  assert_ok(msq_slicer_layer_z(slicer, index, &z));
  memset(data, 0, plan.layer_bytes);
  for (uint32_t j = 0; j < plan.height; ++j)
    for (uint32_t i = 0; i < plan.width; ++i) {
      const double point[3] = {plan.origin[0] + i * plan.pitch[0],
                               plan.origin[1] + j * plan.pitch[1], z};
      int32_t inside;
      assert_ok(msq_point_membership(model, point, &query, &inside));
      if (!inside) continue;
      if (output == MSQ_LAYER_BITS)
        data[j * plan.stride + i / 8] |= (uint8_t)(0x80u >> i % 8);
      else
        data[j * plan.stride + i] = 255;
    }
}

/* The stack's layers, every `step`-th of them, are those that the model has point by point. */
static inline void assert_layers_of(const layer_stack* stack, const msq_model* model,
                                    const msq_slicer* slicer, double length_scale, uint64_t step) {
  uint8_t* wanted = (uint8_t*)malloc(stack->plan.layer_bytes);
  assert_non_null(wanted);
  for (uint64_t k = 0; k < stack->taken; k += step) {
    expect_layer(model, slicer, stack->output, length_scale, stack->first + k, wanted);
    assert_memory_equal(stack->data + k * stack->plan.layer_bytes, wanted, stack->plan.layer_bytes);
  }
  free(wanted);
}

static inline void assert_same_layers(const layer_stack* a, const layer_stack* b) {
  assert_int_equal(a->taken, b->taken);
  assert_int_equal(a->plan.layer_bytes, b->plan.layer_bytes);
  assert_memory_equal(a->data, b->data, a->taken * a->plan.layer_bytes);
}

#endif
