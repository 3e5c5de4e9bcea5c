/* SPDX-License-Identifier: Apache-2.0
 * msq_neighbourhood_placed. */
#include "fixtures.h"

/* A quarter turn about z, twice as large, and moved. */
static const double matrix[12] = {0, -2, 0, 8, 2, 0, 0, -3, 0, 0, 2, 5};

/* A foam on the placed grid holds the placed points. */
static void structures_move_with_their_grid(void** state) {
  msq_context* context = make_context();
  msq_foam_def def;
  msq_structure *foam, *moved;
  msq_shape *box = make_box(context), *placed;
  uint64_t random = 1;
  size_t held = 0;
  (void)state;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  set_cell(&def.grid, 0.75);
  def.grid.origin[1] = 0.25;
  def.radius.value = 0.125;
  assert_ok(msq_structure_foam(context, &def, &foam));
  assert_ok(msq_neighbourhood_placed(&def.grid, matrix, &def.grid)); /* in place */
  assert_near(def.grid.cell_size[2], 1.5, 0);
  def.radius.value = 0.25;
  assert_ok(msq_structure_foam(context, &def, &moved));
  assert_ok(msq_shape_placed(box, matrix, &placed));
  msq_model* here = make_model(context, box, foam, NULL);
  msq_model* there = make_model(context, placed, moved, NULL);
  for (size_t i = 0; i < test_count(5000); ++i) {
    double q[3], p[3], distance;
    for (int axis = 0; axis < 3; ++axis) q[axis] = random_between(&random, 0, 4);
    for (int axis = 0; axis < 3; ++axis) {
      const double* row = matrix + (size_t)axis * 4;
      p[axis] = row[0] * q[0] + row[1] * q[1] + row[2] * q[2] + row[3];
    }
    assert_ok(msq_point_distance(here, q, NULL, &distance));
    if (fabs(distance) < 1e-6) continue;
    assert_int_equal(is_inside(there, p[0], p[1], p[2]), is_inside(here, q[0], q[1], q[2]));
    held += distance < 0;
  }
  assert_true(held > test_count(5000) / 20);
  msq_model_release(here);
  msq_model_release(there);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(structures_move_with_their_grid),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
