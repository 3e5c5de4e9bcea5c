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

/// A structure in a cube.
Model model_of(msq_context* context, msq_structure* structure, double low, double high) {
  Model made{context, nullptr};
  msq_shape* shape;
  const double min[3] = {low, low, low}, max[3] = {high, high, high};
  assert_ok(msq_shape_from_box(context, min, max, &shape));
  msq_scale_def scales[2] = {};
  scales[0].shape = shape;
  scales[1].structure = structure;
  msq_model_def def;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  assert_ok(msq_model_create(context, &def, &made.model));
  msq_shape_release(shape);
  msq_structure_release(structure);
  return made;
}

Model make_model(double low, double high, double cell, int32_t foam_method,
                 const double* rotation = nullptr) {
  msq_context* context;
  msq_structure* structure;
  assert_ok(msq_context_create(nullptr, &context));
  if (foam_method) {
    msq_foam_def def;
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.method = foam_method;
    def.radius.value = 0.2 * cell;
    for (double& size : def.grid.cell_size) size = cell;
    assert_ok(msq_structure_foam(context, &def, &structure));
  } else {
    msq_lattice_def def;
    assert_ok(msq_lattice_def_init(&def, sizeof def));
    def.radius.value = 0.1 * cell;
    for (double& size : def.grid.cell_size) size = cell;
    if (rotation) std::memcpy(def.grid.rotation, rotation, sizeof def.grid.rotation);
    assert_ok(msq_structure_lattice(context, &def, &structure));
  }
  return model_of(context, structure, low, high);
}

/// A lattice of struts or of plates whose radius or thickness is a gradient along all axes.
Model make_graded(bool has_plates) {
  msq_context* context;
  assert_ok(msq_context_create(nullptr, &context));
  const double from[3] = {0, 0, 0}, to[3] = {4, 5, 6};
  msq_field* gradient;
  assert_ok(msq_field_gradient(context, from, 0.05, to, 0.2, &gradient));
  msq_structure* structure;
  if (has_plates) {
    msq_plate_lattice_def def;
    assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
    def.thickness = {0, gradient};
    assert_ok(msq_structure_plate_lattice(context, &def, &structure));
  } else {
    msq_lattice_def def;
    assert_ok(msq_lattice_def_init(&def, sizeof def));
    def.radius = {0, gradient};
    assert_ok(msq_structure_lattice(context, &def, &structure));
  }
  msq_field_release(gradient);
  return model_of(context, structure, 0, 4);
}

/// A lattice in a turned map of samples of that size.
Model make_sampled(double cell) {
  msq_context* context;
  assert_ok(msq_context_create(nullptr, &context));
  msq_warp_def warp;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.kind = MSQ_WARP_SAMPLED;
  msq_field* fields[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    constexpr double turned[9] = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
    double values[27];
    for (size_t i = 0; i < 27; ++i) {
      const size_t at[3] = {i % 3, i / 3 % 3, i / 9};
      values[i] = 2 * static_cast<double>(at[axis]);
    }
    msq_grid_field_def def;
    assert_ok(msq_grid_field_def_init(&def, sizeof def));
    def.image.values = values;
    def.image.value_type = MSQ_FLOAT64;
    std::memcpy(def.image.grid.rotation, turned, sizeof turned);
    for (size_t k = 0; k < 3; ++k) {
      def.image.size[k] = 3;
      def.image.grid.cell_size[k] = 2 * cell;
      def.image.grid.origin[k] = -0.7 * cell;
    }
    assert_ok(msq_field_grid(context, &def, &fields[axis]));
  }
  warp.u = fields[0];
  warp.v = fields[1];
  warp.w = fields[2];
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.05 * cell;
  def.warp = &warp;
  msq_structure* structure;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  for (msq_field* field : fields) msq_field_release(field);
  return model_of(context, structure, 0, 4 * cell);
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

/// Where the radius is linear, too, which would be far from its values a column away.
void graded_planes_of_any_step(void**) {
  for (const bool has_plates : {false, true}) {
    const Model made = make_graded(has_plates);
    size_t inside = 0;
    for (double step : {1e-30, 1.0, 1e5, 1e7, 1e10, 1e21, 1e40, 1e300})
      for (size_t axis = 0; axis < 3; ++axis) {
        double origin[3] = {0.05, 0.06, 0.07}, spacing[3] = {0.1, 0.1, 0.1};
        uint64_t counts[3] = {39, 39, 39};
        origin[axis] = 0.5;
        spacing[axis] = step;
        counts[axis] = 1;
        inside += compare(made, origin, spacing, counts);
      }
    assert_true(inside > 0);
    release(made);
  }
}

void sampled_maps_of_any_size(void**) {
  for (double cell : {1e-60, 1e-38, 1.0, 1e37, 1e38, 1e60}) {
    const Model made = make_sampled(cell);
    const double step = 0.08 * cell;
    assert_true(compare(made, {0.3 * step, 0.4 * step, 0.5 * step}, {step, step, 8 * step},
                        {49, 49, 6}) > 0);
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
      cmocka_unit_test(graded_planes_of_any_step),
      cmocka_unit_test(sampled_maps_of_any_size),
      cmocka_unit_test(matrices_that_are_rotations_nearly),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
