/* SPDX-License-Identifier: Apache-2.0 */
#include "layers.h"

static msq_status stop_with(const msq_slicer* slicer, int32_t code) {
  layer_stack stack = make_stack(slicer, MSQ_LAYER_BITS, 0, 0);
  stack.stop_code = code;
  const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take_layer, &stack, NULL);
  free_stack(&stack);
  return status;
}

static msq_slicer* make_box_slicer(msq_context* context) {
  msq_model* model = make_box_model(context);
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 5, 5, 0.5);
  msq_slicer* slicer = make_slicer(model, &def);
  msq_model_release(model);
  return slicer;
}

static void code_is_zero_before_any_stop(void** state) {
  (void)state;
  assert_int_equal(msq_error_host_code(), 0);
}

static void code_comes_back_whole(void** state) {
  const int32_t codes[] = {-1, -12345, INT32_MIN};
  msq_context* context = make_context();
  msq_slicer* slicer = make_box_slicer(context);
  (void)state;
  for (size_t i = 0; i < sizeof codes / sizeof codes[0]; ++i) {
    char text[16];
    snprintf(text, sizeof text, "%ld", (long)codes[i]);
    assert_refused(stop_with(slicer, codes[i]), MSQ_E_HOST, text);
    assert_int_equal(msq_error_host_code(), codes[i]);
  }
  msq_slicer_release(slicer);
  msq_context_release(context);
}

static void code_outlives_other_calls(void** state) {
  msq_context* context = make_context();
  msq_slicer* slicer = make_box_slicer(context);
  (void)state;
  assert_status(stop_with(slicer, -77), MSQ_E_HOST);
  assert_ok(stop_with(slicer, 0));
  assert_status(msq_cache_clear(NULL), MSQ_E_ARGUMENT);
  assert_int_equal(msq_error_host_code(), -77);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

static void* read_code(void* code) {
  *(int32_t*)code = msq_error_host_code();
  return NULL;
}

static void code_is_per_thread(void** state) {
  msq_context* context = make_context();
  msq_slicer* slicer = make_box_slicer(context);
  pthread_t thread;
  int32_t elsewhere = -1;
  (void)state;
  assert_status(stop_with(slicer, -5), MSQ_E_HOST);
  assert_int_equal(pthread_create(&thread, NULL, read_code, &elsewhere), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_int_equal(elsewhere, 0);
  assert_int_equal(msq_error_host_code(), -5);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(code_is_zero_before_any_stop),
      cmocka_unit_test(code_comes_back_whole),
      cmocka_unit_test(code_outlives_other_calls),
      cmocka_unit_test(code_is_per_thread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
