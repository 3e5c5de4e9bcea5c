/* SPDX-License-Identifier: Apache-2.0
 * msq_window, of grids of points and of slicers. tests/contract/test_windows.cpp and
 * tests/determinism/test_slices.cpp tile grids and layers of every kind. */
#include "definitions.h"
#include "layers.h"

static msq_context* context;
static msq_model* model; /* a BCC lattice from 0 to 4, cells of 1 */

static int set_up(void** state) {
  (void)state;
  context = make_context();
  model = make_lattice_model(context);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}

static msq_window window_of(uint64_t x, uint64_t y, uint64_t z, uint64_t nx, uint64_t ny,
                            uint64_t nz) {
  const msq_window window = {{x, y, z}, {nx, ny, nz}};
  return window;
}

/* 0.1 is no double: shifted origins round differently. */
static msq_points_def grid_of_tenths(void) {
  msq_points_def def = grid_points(0, 4, 41);
  for (int axis = 0; axis < 3; ++axis) def.spacing[axis] = 0.1;
  return def;
}

static void windows_have_the_points_and_values_of_the_grid(void** state) {
  enum { side = 41, all = side * side * side };
  static const uint64_t cut[4] = {0, 1, 17, side};
  msq_points_def def = grid_of_tenths();
  uint8_t* whole = (uint8_t*)malloc(all);
  uint8_t* part = (uint8_t*)malloc(all);
  double* distances = (double*)malloc(all * sizeof(double));
  double* some = (double*)malloc(all * sizeof(double));
  (void)state;
  assert_ok(msq_set_membership(model, &def, NULL, whole, all, NULL));
  assert_ok(msq_set_distance(model, &def, NULL, distances, all, NULL));
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) {
        const uint64_t nx = cut[a + 1] - cut[a], ny = cut[b + 1] - cut[b], nz = cut[c + 1] - cut[c];
        const uint64_t count = nx * ny * nz;
        double point[3];
        def.window = window_of(cut[a], cut[b], cut[c], nx, ny, nz);
        assert_ok(msq_set_membership(model, &def, NULL, part, count, NULL));
        assert_ok(msq_set_distance(model, &def, NULL, some, count, NULL));
        for (uint64_t n = 0; n < count; ++n) {
          const uint64_t at[3] = {cut[a] + n % nx, cut[b] + n / nx % ny, cut[c] + n / nx / ny};
          const uint64_t number = at[0] + side * (at[1] + side * at[2]);
          if (part[n] != whole[number] || some[n] != distances[number])
            fail_msg("point %d, %d, %d", (int)at[0], (int)at[1], (int)at[2]);
        }
        assert_ok(msq_points_generate(&def, count - 1, 1, point));
        assert_true(point[0] == (double)(cut[a + 1] - 1) * 0.1);
        assert_true(point[1] == (double)(cut[b + 1] - 1) * 0.1);
        assert_true(point[2] == (double)(cut[c + 1] - 1) * 0.1);
      }
  assert_refused(msq_points_generate(&def, 0, all, some), MSQ_E_ARGUMENT, "there are");
  assert_refused(msq_set_membership(model, &def, NULL, part, all, NULL), MSQ_E_ARGUMENT,
                 "inside_count");
  free(some);
  free(distances);
  free(part);
  free(whole);
}

/* The whole grid is too large to be computed, and the window is at its very end. */
static void windows_of_the_largest_grid(void** state) {
  enum { n = 5 };
  const uint64_t largest = INT32_MAX, first = largest - n;
  msq_points_def def = grid_points(0, 4, 5);
  uint8_t inside[n * n * n];
  double point[3];
  (void)state;
  for (int axis = 0; axis < 3; ++axis) {
    def.counts[axis] = largest;
    def.spacing[axis] = 0.1;
    def.origin[axis] = -0.1 * (double)first;
  }
  assert_refused(msq_set_membership(model, &def, NULL, inside, sizeof inside, NULL), MSQ_E_LIMIT,
                 "2^63");
  def.window = window_of(first, first, first, n, n, n);
  assert_ok(msq_set_membership(model, &def, NULL, inside, sizeof inside, NULL));
  for (uint64_t i = 0; i < sizeof inside; ++i) {
    assert_ok(msq_points_generate(&def, i, 1, point));
    assert_true(point[0] == def.origin[0] + (double)(first + i % n) * 0.1);
    assert_int_equal(inside[i], is_inside(model, point[0], point[1], point[2]));
  }
}

/* A host that was built before windows leaves them out, whatever lies behind its struct. */
static void older_definitions_have_no_window(void** state) {
  msq_points_def points = grid_of_tenths();
  msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.1);
  double point[3];
  (void)state;
  memset(&points.window, 0x55, sizeof points.window);
  points.struct_size = offsetof(msq_points_def, window);
  assert_ok(msq_points_generate(&points, 41 * 41 * 41 - 1, 1, point));
  memset(&plan.window, 0x55, sizeof plan.window);
  plan.struct_size = offsetof(msq_slicer_def, window);
  msq_slicer* slicer = make_slicer(model, &plan);
  const msq_slicer_report report = plan_of(slicer);
  assert_int_equal(report.width, 40);
  assert_int_equal(report.layer_count, 40);
  for (int axis = 0; axis < 3; ++axis) {
    assert_int_equal(report.window.first[axis], 0);
    assert_int_equal(report.window.count[axis], 40);
    assert_int_equal(report.whole[axis], 40);
  }
  msq_slicer_release(slicer);
}

/* Panels of a printer that is too wide for one picture, all layers or some. */
static void panels_have_the_bytes_of_the_layer(void** state) {
  static const uint64_t cut[4] = {0, 7, 30, 40};
  static const double heights[5] = {0.05, 0.3, 1.1, 2.7, 3.9};
  (void)state;
  for (int is_listed = 0; is_listed < 2; ++is_listed) {
    msq_slicer_def def = slicer_def(MSQ_LAYER_BYTES, 40, 40, 0.8);
    if (is_listed) {
      def.layer_height = 0;
      def.layer_z = heights;
      def.layer_z_count = 5;
    }
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack whole = run_all(slicer, MSQ_LAYER_BYTES);
    for (uint64_t z = 0; z < 5; z += 2)
      for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a) {
          const uint64_t nz = z == 4 ? 1 : 2;
          def.window = window_of(cut[a], cut[b], z, cut[a + 1] - cut[a], cut[b + 1] - cut[b], nz);
          msq_slicer* panel = make_slicer(model, &def);
          layer_stack stack = run_all(panel, MSQ_LAYER_BYTES);
          const msq_slicer_report* plan = &stack.plan;
          assert_int_equal(plan->layer_count, nz);
          assert_int_equal(plan->width, cut[a + 1] - cut[a]);
          assert_memory_equal(&plan->window, &def.window, sizeof def.window);
          assert_int_equal(plan->whole[0], 40);
          assert_int_equal(plan->whole[2], 5);
          assert_true(plan->origin[0] == whole.plan.origin[0]);
          for (uint64_t k = 0; k < nz; ++k) {
            double in_panel, in_whole;
            assert_ok(msq_slicer_layer_z(panel, k, &in_panel));
            assert_ok(msq_slicer_layer_z(slicer, z + k, &in_whole));
            assert_true(in_panel == in_whole);
            for (uint64_t j = 0; j < plan->height; ++j)
              assert_memory_equal(stack.data + k * plan->layer_bytes + j * plan->stride,
                                  whole.data + (z + k) * whole.plan.layer_bytes +
                                      (cut[b] + j) * whole.plan.stride + cut[a],
                                  plan->width);
          }
          assert_refused(msq_slicer_layer_z(panel, nz, &def.pitch[0]), MSQ_E_ARGUMENT, "layers");
          free_stack(&stack);
          msq_slicer_release(panel);
        }
    free_stack(&whole);
    msq_slicer_release(slicer);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(windows_have_the_points_and_values_of_the_grid),
      cmocka_unit_test(windows_of_the_largest_grid),
      cmocka_unit_test(older_definitions_have_no_window),
      cmocka_unit_test(panels_have_the_bytes_of_the_layer),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
