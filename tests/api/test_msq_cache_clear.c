/* SPDX-License-Identifier: Apache-2.0 */
#include "layers.h"

static msq_slicer* make_foam_slicer(msq_context* context) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.2);
  msq_model* model = make_foam_model(context, MSQ_FOAM_DIRECT);
  msq_slicer* slicer = make_slicer(model, &def);
  msq_model_release(model);
  return slicer;
}

static void clear_drops_cells_and_keeps_counters(void** state) {
  msq_context* context = make_context();
  msq_slicer* slicer = make_foam_slicer(context);
  (void)state;
  layer_stack first = run_all(slicer, MSQ_LAYER_BITS);
  const msq_cache_report before = cache_of(context);
  assert_true(before.bytes > 0);
  assert_int_equal(memory_of(context).bytes, before.bytes);

  assert_ok(msq_cache_clear(context));
  const msq_cache_report after = cache_of(context);
  assert_int_equal(after.bytes, 0);
  assert_int_equal(memory_of(context).bytes, 0);
  assert_int_equal(after.hits, before.hits);
  assert_int_equal(after.misses, before.misses);
  assert_int_equal(after.evictions, before.evictions);
  assert_int_equal(after.peak_bytes, before.peak_bytes);

  layer_stack second = run_all(slicer, MSQ_LAYER_BITS);
  assert_same_layers(&first, &second);
  assert_true(cache_of(context).misses > after.misses);
  free_stack(&first);
  free_stack(&second);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

static void empty_cache_can_be_cleared(void** state) {
  msq_context* context = make_context_of(1, 0, 0);
  (void)state;
  assert_ok(msq_cache_clear(context));
  assert_ok(msq_cache_clear(context));
  msq_context_release(context);
}

typedef struct clearing {
  layer_stack stack;
  msq_context* context;
  msq_status status;
} clearing;

static int32_t clear_and_take(void* user, const msq_layer* layer) {
  clearing* c = (clearing*)user;
  const msq_status status = msq_cache_clear(c->context);
  if (status != MSQ_OK) c->status = status;
  return take_layer(&c->stack, layer);
}

static void clear_during_a_run_changes_nothing(void** state) {
  clearing c = {0};
  c.context = make_context();
  msq_slicer* slicer = make_foam_slicer(c.context);
  layer_stack wanted = run_all(slicer, MSQ_LAYER_BITS);
  (void)state;
  c.stack = make_stack(slicer, MSQ_LAYER_BITS, 0, wanted.room);
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, clear_and_take, &c, NULL));
  assert_ok(c.status);
  assert_same_layers(&wanted, &c.stack);
  free_stack(&wanted);
  free_stack(&c.stack);
  msq_slicer_release(slicer);
  msq_context_release(c.context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clear_drops_cells_and_keeps_counters),
      cmocka_unit_test(empty_cache_can_be_cleared),
      cmocka_unit_test(clear_during_a_run_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
