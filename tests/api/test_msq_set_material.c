/* SPDX-License-Identifier: Apache-2.0
 * msq_set_material. */
#include "materials.h"

enum { SIDE = 24, COUNT = SIDE * SIDE * SIDE };

static void a_set_answers_as_its_points(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_material_model(context, 1, 1, 1);
  static double coordinates[COUNT][3], values[COUNT][2];
  static uint32_t ids[COUNT];
  uint64_t random = 1;
  size_t of[4] = {0};
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  for (int is_grid = 0; is_grid < 2; ++is_grid) {
    msq_points_def points = grid_points(-0.25, 4.25, SIDE);
    if (!is_grid) {
      assert_ok(msq_points_def_init(&points, sizeof points));
      points.coordinates = coordinates;
      points.count = COUNT;
    }
    for (int i = 0; i < COUNT; ++i)
      for (int a = 0; a < 3; ++a) coordinates[i][a] = random_between(&random, -0.25, 4.25);
    if (is_grid) assert_ok(msq_points_generate(&points, 0, COUNT, coordinates[0]));
    memset(ids, 0xff, sizeof ids);
    memset(values, 0xff, sizeof values);
    assert_ok(msq_set_material(model, &points, NULL, material_channels, 2, ids, COUNT, values[0],
                               2 * COUNT, job));
    assert_true(progress_of(job) == 1);
    for (int i = 0; i < COUNT; ++i) {
      double wanted[2];
      uint32_t id;
      assert_ok(msq_point_material(model, coordinates[i], NULL, material_channels, 2, &id, wanted));
      assert_int_equal(ids[i], id);
      assert_memory_equal(values[i], wanted, sizeof wanted);
      ++of[id];
    }
  }
  assert_true(of[0] > 1000 && of[1] == 0 && of[2] > 1000 && of[3] > 1000);
  assert_ok(msq_job_cancel(job));
  const msq_points_def points = grid_points(-0.25, 4.25, SIDE);
  assert_refused(msq_set_material(model, &points, NULL, NULL, 0, ids, COUNT, NULL, 0, job),
                 MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_set_answers_as_its_points),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
