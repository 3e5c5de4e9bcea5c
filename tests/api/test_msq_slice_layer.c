/* SPDX-License-Identifier: Apache-2.0
 * msq_slice_layer. Cancelling: test_msq_job_cancel.c. Memory limit: test_msq_context_memory.c. */
#include "definitions.h"
#include "layers.h"

/* The bytes are those of a run, and the buffer's other bytes are left alone; takes over the model.
 */
static void check_layers(msq_model* model) {
  for (int32_t output = MSQ_LAYER_BITS; output <= MSQ_LAYER_BYTES; ++output) {
    const msq_slicer_def def = slicer_def(output, 70, 45, 0.25);
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack wanted = run_all(slicer, output);
    const uint64_t bytes = wanted.plan.layer_bytes;
    uint8_t* buffer = (uint8_t*)malloc(bytes + 32);
    for (uint64_t i = wanted.taken; i-- > 0;) { /* in any order */
      memset(buffer, struct_pattern, bytes + 32);
      /* At an odd address, with room to spare. */
      assert_ok(msq_slice_layer(slicer, i, buffer + 1, bytes + 31, NULL));
      assert_memory_equal(buffer + 1, wanted.data + i * bytes, bytes);
      assert_filled(buffer, 1, struct_pattern);
      assert_filled(buffer + 1 + bytes, 31, struct_pattern);
      assert_ok(msq_slice_layer(slicer, i, buffer, bytes, NULL));
      assert_memory_equal(buffer, wanted.data + i * bytes, bytes);
    }
    free(buffer);
    free_stack(&wanted);
    msq_slicer_release(slicer);
  }
  msq_model_release(model);
}

static void layer_is_that_of_a_run(void** state) {
  msq_context* context = make_context();
  (void)state;
  check_layers(make_lattice_model(context));
  check_layers(make_model(context, make_cube_mesh(context), make_lattice(context), NULL));
  check_layers(make_foam_model(context, MSQ_FOAM_DIRECT));
  check_layers(make_foam_model(context, MSQ_FOAM_METHOD_1));
#if MSQ_WITH_CGAL
  check_layers(make_foam_model(context, MSQ_FOAM_METHOD_2));
#endif
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layer_is_that_of_a_run),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
