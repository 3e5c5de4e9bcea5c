/* SPDX-License-Identifier: Apache-2.0
 * As test_float_state.c, for structures of more than one part and for all outputs: the results are
 * the same in any floating-point environment of the host, which gets its own back. */
#include "hosts.h"

#include "float_kinds.h"
#include "float_outputs.h"
#include "float_questions.h"

/* Every call on one structure. */
static void ask_kind(uint32_t threads, enum compound_kind kind) {
  static const double min[3] = {0.1, 0, 0.05}, max[3] = {1.9, 1.7, 1.6};
  msq_context_def def;
  msq_context* context = NULL;
  msq_structure* structure = NULL;
  msq_shape* shape = NULL;
  msq_model_def model_def;
  msq_model* model = NULL;
  msq_scale_def scales[2];
  CALL(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  CALL(msq_context_create(&def, &context));
  CALL(make_compound(context, kind, &structure));
  CALL(msq_shape_from_box(context, min, max, &shape));
  if (!structure || !shape) fail_msg("kind %d: %s", (int)kind, msq_error_message());
  memset(scales, 0, sizeof scales);
  scales[0].shape = shape;
  scales[1].structure = structure;
  CALL(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  CALL(msq_model_create(context, &model_def, &model));
  IN_STATE(msq_shape_release(shape));
  ask_points(model);
  ask_statistics(context, model, NULL);
  ask_layers(model);
  ask_rays(model);
  ask_outputs(context, model, structure);
  IN_STATE(msq_structure_release(structure));
  IN_STATE(msq_model_release(model));
  IN_STATE(msq_context_release(context));
  assert_right_states();
}

static void test_kinds(void** state) {
  (void)state;
  sample_map();
  host_thread = pthread_self();
  for (int kind = 0; kind < compound_kinds; ++kind) {
    /* With few samples: the default environment and some others, which differ by kind. */
    const int step = test_scale() < 0.5 ? 3 + kind % 4 : 1;
    for (host_state = 0; host_state < state_count; host_state += step) {
      is_other = host_state > 0;
      answer_bytes[is_other] = 0;
      ask_kind((uint32_t)(1 + kind % 2), (enum compound_kind)kind);
      if (!is_other) continue;
      assert_int_equal(answer_bytes[1], answer_bytes[0]);
      if (memcmp(answers[0], answers[1], answer_bytes[0]) != 0)
        fail_msg("structure %d: other results in environment \"%s\"", kind,
                 state_names[host_state]);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_kinds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
