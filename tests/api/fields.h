/* SPDX-License-Identifier: Apache-2.0
 * Reading a field from outside: what a structure built with it answers. */
#ifndef FIELDS_H
#define FIELDS_H

#include "definitions.h"

/* The value of a field between -1024 and 1024, within 1e-9, at a point within 100 of the origin.
 * The function that is c everywhere is at most a level that is the field where c is: c is sought.
 */
static inline double field_at(msq_context* context, const msq_field* field, double x, double y,
                              double z) {
  const double point[3] = {x, y, z};
  double low = -1024, high = 1024;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    const msq_named_value c = {"c", middle};
    msq_functional_def def;
    msq_structure* structure;
    int32_t inside = -1;
    assert_ok(msq_functional_def_init(&def, sizeof def));
    def.function = MSQ_FUNCTION_EXPRESSION;
    def.expression = "c";
    def.parameters = &c;
    def.parameter_count = 1;
    def.level.field = field;
    def.clusters = 1;
    assert_ok(msq_structure_functional(context, &def, &structure));
    msq_model* model = make_model(context, make_box_of(context, -100, 100), structure, NULL);
    assert_ok(msq_point_membership(model, point, NULL, &inside));
    msq_model_release(model);
    if (inside)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

#endif
