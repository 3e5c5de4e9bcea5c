// SPDX-License-Identifier: Apache-2.0
// Grids that reach far beyond the shape, and matrices that are rotations only nearly: the answers
// are those of the point query, and come in the time that the samples in the shape take.
#include <cmath>
#include <cstring>
#include <vector>

#include "msq_test.h"

namespace {

struct Model {
  msq_context* context = nullptr;
  msq_model* model = nullptr;
};

Model make_model(double low, double high, double cell, int32_t foam_method,
                 const double* rotation = nullptr) {
  Model made;
  msq_shape* shape;
  msq_structure* structure;
  const double min[3] = {low, low, low}, max[3] = {high, high, high};
  assert_ok(msq_context_create(nullptr, &made.context));
  assert_ok(msq_shape_from_box(made.context, min, max, &shape));
  if (foam_method) {
    msq_foam_def def;
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.method = foam_method;
    def.radius.value = 0.2 * cell;
    for (double& size : def.grid.cell_size) size = cell;
    assert_ok(msq_structure_foam(made.context, &def, &structure));
  } else {
    msq_lattice_def def;
    assert_ok(msq_lattice_def_init(&def, sizeof def));
    def.radius.value = 0.1 * cell;
    for (double& size : def.grid.cell_size) size = cell;
    if (rotation) std::memcpy(def.grid.rotation, rotation, sizeof def.grid.rotation);
    assert_ok(msq_structure_lattice(made.context, &def, &structure));
  }
  msq_scale_def scales[2] = {};
  scales[0].shape = shape;
  scales[1].structure = structure;
  msq_model_def def;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  assert_ok(msq_model_create(made.context, &def, &made.model));
  msq_shape_release(shape);
  msq_structure_release(structure);
  return made;
}

void release(const Model& made) {
  msq_model_release(made.model);
  msq_context_release(made.context);
}

/// Asks a grid at once and point by point; returns how many are inside.
size_t compare(const Model& made, const double (&origin)[3], const double (&spacing)[3],
               const uint64_t (&counts)[3]) {
  msq_points_def points;
  assert_ok(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    points.origin[axis] = origin[axis];
    points.spacing[axis] = spacing[axis];
    points.counts[axis] = counts[axis];
  }
  std::vector<uint8_t> inside(counts[0] * counts[1] * counts[2]);
  assert_ok(
      msq_set_membership(made.model, &points, nullptr, inside.data(), inside.size(), nullptr));
  size_t index = 0, count = 0, wrong = 0;
  for (uint64_t k = 0; k < counts[2]; ++k)
    for (uint64_t j = 0; j < counts[1]; ++j)
      for (uint64_t i = 0; i < counts[0]; ++i, ++index) {
        const double p[3] = {origin[0] + static_cast<double>(i) * spacing[0],
                             origin[1] + static_cast<double>(j) * spacing[1],
                             origin[2] + static_cast<double>(k) * spacing[2]};
        int32_t expected;
        assert_ok(msq_point_membership(made.model, p, nullptr, &expected));
        wrong += inside[index] != expected;
        count += inside[index];
      }
  assert_int_equal(wrong, 0);
  return count;
}

void steps_far_beyond_the_shape(void**) {
  for (int32_t method : {0, int32_t{MSQ_FOAM_DIRECT}}) {
    const Model made = make_model(0, 1, 0.1, method);
    for (double far : {10.0, 1e10, 3e11, 1e40, 1e300}) {
      compare(made, {0.5, 0.013, 0.017}, {far, 0.025, 0.05}, {4, 40, 20});
      compare(made, {0.013, 0.5, 0.017}, {0.025, far, 0.05}, {40, 4, 20});
      compare(made, {0.013, 0.017, 0.5}, {0.025, 0.05, far}, {40, 20, 4});
    }
    release(made);
  }
}

void one_row_or_layer_of_any_step(void**) {
  for (int32_t method : {0, int32_t{MSQ_FOAM_DIRECT}}) {
    const Model made = make_model(0, 1, 0.1, method);
    size_t inside = 0;
    for (double step : {1e-30, 1.0, 1e40, 1e300}) {
      inside += compare(made, {0.001, 0.05, 0.002}, {0.001, step, 0.004}, {990, 1, 240});
      inside += compare(made, {0.001, 0.002, 0.05}, {0.001, 0.004, step}, {990, 240, 1});
    }
    assert_true(inside > 0);
    release(made);
  }
}

void matrices_that_are_rotations_nearly(void**) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (double off : {0.0, 1e-10, 4e-10}) {
    const double m = 1 + off;
    const double rotation[9] = {c * m, -s * m, 0, s * m, c * m, 0, 0, 0, m};
    for (double at : {0.0, 1e3, 1e5}) {
      const Model made = make_model(at, at + 4, 1, 0, rotation);
      compare(made, {at + 0.01, at + 0.02, at + 0.03}, {0.0391, 0.0391, 0.0391}, {100, 100, 20});
      release(made);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(steps_far_beyond_the_shape),
      cmocka_unit_test(one_row_or_layer_of_any_step),
      cmocka_unit_test(matrices_that_are_rotations_nearly),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
