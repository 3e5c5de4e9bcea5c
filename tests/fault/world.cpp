// SPDX-License-Identifier: Apache-2.0
#include "world.h"

#include <cmath>
#include <cstring>

namespace msq::test {

namespace {

constexpr double corners[8][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0},
                                  {0, 0, 4}, {4, 0, 4}, {0, 4, 4}, {4, 4, 4}};
constexpr uint32_t triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                       {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

}  // namespace

int32_t host_values(void*, const double* points, uint64_t count, double* values) {
  for (uint64_t i = 0; i < count; ++i) values[i] = 0.15 + 0.05 * std::tanh(points[3 * i] - 2);
  return 0;
}

int32_t host_range(void*, const double min[3], const double max[3], double* low, double* high) {
  *low = 0.15 + 0.05 * std::tanh(min[0] - 2) - 1e-9;
  *high = 0.15 + 0.05 * std::tanh(max[0] - 2) + 1e-9;
  return 0;
}

int32_t host_inside(void*, const double* points, uint64_t count, uint8_t* inside) {
  for (uint64_t i = 0; i < count; ++i) {
    double squared = 0;
    for (uint64_t axis = 0; axis < 3; ++axis) squared += std::pow(points[3 * i + axis] - 2, 2);
    inside[i] = squared <= 3.9;
  }
  return 0;
}

World::World(const Stage& stage) {
  msq_context_def def = make_def(msq_context_def_init);
  def.threads = stage.threads;
  require_ok(msq_context_create(&def, &context));
  keep(context);
}

World::~World() {
  for (; !kept_.empty(); kept_.pop_back()) kept_.back()();
}

msq_shape* World::box() {
  const double min[3] = {0, 0, 0}, max[3] = {4, 4, 4};
  msq_shape* shape;
  require_ok(msq_shape_from_box(context, min, max, &shape));
  return keep(shape);
}

msq_shape* World::mesh() {
  msq_mesh_def def = make_def(msq_mesh_def_init);
  def.vertices = corners;
  def.vertex_count = 8;
  def.triangles = triangles[0];
  def.triangle_count = 12;
  msq_shape* shape;
  require_ok(msq_shape_from_mesh(context, &def, &shape));
  return keep(shape);
}

msq_shape* World::voxels() {
  uint8_t values[9 * 9 * 9];
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    const int x = i % 9 - 4, y = i / 9 % 9 - 4, z = i / 81 - 4;
    values[i] = static_cast<uint8_t>(200 - 10 * (x * x + y * y + z * z) / 2);
  }
  msq_voxels_def def = make_def(msq_voxels_def_init);
  def.image.values = values;
  def.image.value_type = MSQ_UINT8;
  for (int axis = 0; axis < 3; ++axis) {
    def.image.size[axis] = 9;
    def.image.grid.cell_size[axis] = 0.5;
  }
  def.threshold = 130;
  msq_shape* shape;
  require_ok(msq_shape_from_voxels(context, &def, &shape));
  return keep(shape);
}

msq_shape* World::host_shape() {
  msq_host_shape_def def = make_def(msq_host_shape_def_init);
  def.inside = host_inside;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 0;
    def.max[axis] = 4;
  }
  msq_shape* shape;
  require_ok(msq_shape_from_host(context, &def, &shape));
  return keep(shape);
}

msq_field* World::gradient() {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 2};
  msq_field* field;
  require_ok(msq_field_gradient(context, from, 0.1, to, 0.25, &field));
  return keep(field);
}

msq_field* World::expression() {
  msq_expression_field_def def = make_def(msq_expression_field_def_init);
  def.expression = "0.15 + 0.05 * sin(x) * cos(y + z)";
  def.low = 0.1;
  def.high = 0.2;
  msq_field* field;
  require_ok(msq_field_expression(context, &def, &field));
  return keep(field);
}

msq_field* World::host_field() {
  msq_host_field_def def = make_def(msq_host_field_def_init);
  def.evaluate = host_values;
  def.range = host_range;
  def.low = 0.1;
  def.high = 0.2;
  def.lipschitz = 0.05;
  msq_field* field;
  require_ok(msq_field_host(context, &def, &field));
  return keep(field);
}

msq_material* World::material(uint32_t id) {
  const msq_channel channel = {"density", {0, gradient()}};
  msq_material_def def = make_def(msq_material_def_init);
  def.id = id;
  def.channels = &channel;
  def.channel_count = 1;
  msq_material* material;
  require_ok(msq_material_create(context, &def, &material));
  return keep(material);
}

msq_model* World::model(msq_shape* shape, msq_structure* structure, double skin) {
  msq_scale_def scales[2];
  std::memset(scales, 0, sizeof scales);
  scales[0].shape = shape;
  scales[0].material = material(1);
  scales[1].structure = structure;
  scales[1].skin.value = skin;
  scales[1].material = material(2);
  msq_model_def def = make_def(msq_model_def_init);
  def.scales = scales;
  def.scale_count = structure ? 2 : 1;
  msq_model* model;
  require_ok(msq_model_create(context, &def, &model));
  return keep(model);
}

msq_slicer* World::slicer(const msq_model* model, bool is_slow) {
  msq_slicer_def def = make_def(msq_slicer_def_init);
  def.resolution[0] = is_slow ? 5 : 70;
  def.resolution[1] = is_slow ? 3 : 9;
  def.layer_height = 0.9;
  def.slab_layers = 2;
  msq_slicer* slicer;
  require_ok(msq_slicer_create(model, &def, &slicer));
  return keep(slicer);
}

msq_slicer_report plan_of(const msq_slicer* slicer) {
  msq_slicer_report plan = {};
  plan.struct_size = sizeof plan;
  require_ok(msq_slicer_info(slicer, &plan));
  return plan;
}

std::vector<double> some_points(size_t count) {
  std::vector<double> coordinates(3 * count);
  uint64_t state = 7;
  for (double& x : coordinates) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = 4.4 * static_cast<double>(state >> 11) * 0x1p-53 - 0.2;
  }
  return coordinates;
}

msq_points_def array_of(const std::vector<double>& coordinates) {
  msq_points_def def = make_def(msq_points_def_init);
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = coordinates.data();
  def.count = coordinates.size() / 3;
  return def;
}

msq_points_def grid_of(uint64_t side) {
  msq_points_def def = make_def(msq_points_def_init);
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = 0.31;
    def.spacing[axis] = 3.4 / static_cast<double>(side);
    def.counts[axis] = side;
  }
  return def;
}

msq_points_def strata_of(uint64_t side, uint32_t per_cell) {
  msq_points_def def = make_def(msq_points_def_init);
  def.kind = MSQ_POINTS_STRATIFIED;
  def.per_cell = per_cell;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = 0.2;
    def.spacing[axis] = 3.6 / static_cast<double>(side);
    def.counts[axis] = side;
  }
  return def;
}

}  // namespace msq::test
