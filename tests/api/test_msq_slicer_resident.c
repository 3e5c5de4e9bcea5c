/* SPDX-License-Identifier: Apache-2.0
 * Resident memory of a run follows the memory limit, also where the samples of a layer exceed it.
 */
#define _POSIX_C_SOURCE 200809L /* getrusage */
#include <sys/resource.h>

#include "layers.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
    __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif

#ifdef IS_SANITIZED
enum { is_sanitized = 1 }; /* shadow memory counts as resident */
#else
enum { is_sanitized = 0 };
#endif

/* The most so far, in bytes. */
static uint64_t resident(void) {
  struct rusage usage;
  assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
#ifdef __APPLE__
  return (uint64_t)usage.ru_maxrss;
#else
  return (uint64_t)usage.ru_maxrss * 1024;
#endif
}

static int32_t count_layers(void* user, const msq_layer* layer) {
  *(uint64_t*)user += layer->inside_count > 0;
  return 0;
}

/* The library, its threads and what they keep. */
static const uint64_t of_process = 12u << 20;

static void resident_memory_follows_the_limit(void** state) {
  /* Without bands: 80 and 96 MiB, and for samples of a layer alone 32 and 32. */
  const struct {
    int32_t output;
    uint32_t pixels;
    uint64_t limit;
  } cases[2] = {{MSQ_LAYER_GREY, 4096, 28u << 20}, {MSQ_LAYER_BITS, 16384, 40u << 20}};
  (void)state;
  const uint64_t before = resident();
  for (int i = 0; i < 2; ++i) {
    msq_slicer_def def = slicer_def(cases[i].output, cases[i].pixels, cases[i].pixels, 0.25);
    msq_context* context = make_context_of(2, 0, cases[i].limit);
    msq_model* model = make_lattice_model(context);
    msq_slicer* slicer = make_slicer(model, &def);
    uint64_t layers = 0;
    assert_ok(msq_slicer_run(slicer, 0, 2, count_layers, &layers, NULL));
    assert_int_equal(layers, 2);
    assert_in_range(memory_of(context).peak_bytes, plan_of(slicer).layer_bytes, cases[i].limit);
    if (!is_sanitized)
      assert_in_range(resident() - before, plan_of(slicer).layer_bytes,
                      cases[i].limit + of_process);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(resident_memory_follows_the_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
