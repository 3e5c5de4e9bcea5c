/* SPDX-License-Identifier: Apache-2.0
 * What the definitions of lattices and foams have in common: grid and radius. */
#ifndef STRUCTURES_H
#define STRUCTURES_H

#include "definitions.h"

/* Every way for a grid to be wrong, tried on a definition whose grid this is. */
static inline void check_grid_refusals(msq_neighbourhood* grid, use_fn create, void* env,
                                       void* def) {
  const msq_neighbourhood good = *grid;
  for (int which = 0; which < 3; ++which) {
    for (int axis = 0; axis < 3; ++axis) {
      grid->origin[axis] = not_finite(which);
      assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.origin");
      *grid = good;
      grid->cell_size[axis] = not_finite(which);
      assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.cell_size");
      *grid = good;
    }
    for (int i = 0; i < 9; ++i) {
      grid->rotation[i] = not_finite(which);
      assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.rotation");
      *grid = good;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    grid->cell_size[axis] = 0;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.cell_size is 0;");
    grid->cell_size[axis] = -2;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.cell_size is -2;");
    grid->cell_size[axis] = 9.5e-76;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "is 9.5e-76; it must be from 1e-75 to 1e75");
    grid->cell_size[axis] = 1.5e75;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "is 1.5e+75; it must be from 1e-75 to 1e75");
    *grid = good;
  }
  for (int i = 0; i < 9; ++i) { /* orthonormal within 1e-9 */
    grid->rotation[i] += 1e-7;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.rotation");
    assert_message_has("1e-9");
    *grid = good;
    grid->rotation[i] += 1e-10;
    assert_ok(create(env, def));
    *grid = good;
  }
  for (int axis = 0; axis < 3; ++axis) {
    grid->rotation[4 * axis] = -1;
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "determinant");
    *grid = good;
  }
  memset(grid->rotation, 0, sizeof grid->rotation);
  assert_refused(create(env, def), MSQ_E_ARGUMENT, "grid.rotation");
  *grid = good;
}

/* Every way for a radius to be wrong; most: the limit for the definition's grid. */
static inline void check_radius_refusals(msq_param* radius, double most, msq_context* context,
                                         use_fn create, void* env, void* def) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 0, 0};
  const double refused[] = {0, -0.5, NAN, INFINITY, -INFINITY};
  const double low[] = {-0.25, 0, 0}, high[] = {0.25, 0, 2 * most};
  const char* texts[] = {"-0.25", "0 everywhere", "limit"};
  const msq_param good = *radius;
  char text[32];
  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    radius->value = refused[i];
    assert_refused(create(env, def), MSQ_E_ARGUMENT, "radius is ");
  }
  radius->value = most;
  assert_ok(create(env, def));
  radius->value = most * 1.0009765625;
  assert_refused(create(env, def), MSQ_E_LIMIT, "radius");
  snprintf(text, sizeof text, "%g", radius->value);
  assert_message_has(text);
  snprintf(text, sizeof text, "the limit is %g", most);
  assert_message_has(text);

  for (int i = 0; i < 3; ++i) {
    msq_field* field;
    assert_ok(msq_field_gradient(context, from, low[i], to, high[i], &field));
    radius->field = field;
    assert_refused(create(env, def), i < 2 ? MSQ_E_ARGUMENT : MSQ_E_LIMIT, texts[i]);
    assert_message_has("radius");
    msq_field_release(field);
  }
  *radius = good;
}

#endif
