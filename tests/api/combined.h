/* SPDX-License-Identifier: Apache-2.0
 * Models of structures that are made of others, which the tests keep. */
#ifndef MSQ_TEST_COMBINED_H
#define MSQ_TEST_COMBINED_H

#include "layers.h"

/* Takes over the shape and keeps the structure. */
static inline msq_model* model_with(msq_context* context, msq_shape* shape,
                                    msq_structure* structure) {
  msq_structure_retain(structure);
  return make_model(context, shape, structure, NULL);
}

static inline msq_model* in_all_space(msq_context* context, msq_structure* structure) {
  msq_shape* shape;
  assert_ok(msq_shape_all_space(context, &shape));
  return model_with(context, shape, structure);
}

static inline layer_stack layers_of(msq_context* context, msq_structure* structure) {
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 150, 40, 0.4);
  msq_model* model = model_with(context, make_box(context), structure);
  msq_slicer* slicer = make_slicer(model, &def);
  layer_stack all = run_all(slicer, MSQ_LAYER_BITS);
  msq_slicer_release(slicer);
  msq_model_release(model);
  return all;
}

#endif
