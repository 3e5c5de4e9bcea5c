// SPDX-License-Identifier: Apache-2.0
// C++ exceptions that leave callbacks of shapes, structures and functions of the host, at the first
// call, the second, the fourth and so on: MSQ_E_HOST, the next call is right, and no cell is lost.
#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "msq_test.h"

namespace {

/// Throws at a call of its callback, or at that and all later ones.
class Thrower {
 public:
  void begin(uint64_t at, bool goes_on) {
    calls_ = thrown_ = 0;
    at_ = at;
    goes_on_ = goes_on;
  }
  /// How often it threw.
  uint64_t end() {
    at_ = 0;
    return thrown_;
  }
  void operator()() {
    const uint64_t call = ++calls_;
    if (at_ == 0 || (goes_on_ ? call < at_ : call != at_)) return;
    ++thrown_;
    throw std::runtime_error("no ink");
  }

 private:
  std::atomic<uint64_t> calls_{0}, thrown_{0};
  uint64_t at_ = 0;
  bool goes_on_ = false;
};

Thrower at_inside, at_distance, at_box, at_build, at_evaluate;
std::atomic<int64_t> cells{0};
std::atomic<bool> frees_what_is_not_there{false};
char not_there;

using Output = std::vector<unsigned char>;

template <class T>
void append(Output& output, const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  output.insert(output.end(), bytes, bytes + values.size() * sizeof(T));
}

/// Throws later and later until the call does not reach it. Returns how many calls failed.
template <class Call>
int count_stops(Thrower& thrower, Call&& call) {
  Output right;
  assert_ok(call(right));
  int stops = 0;
  for (uint64_t at = 1;; at *= 2) {
    bool has_thrown = false;
    for (const bool goes_on : {false, true}) {
      Output output;
      thrower.begin(at, goes_on);
      const msq_status status = call(output);
      const uint64_t thrown = thrower.end();
      assert_int_equal(status, thrown ? MSQ_E_HOST : MSQ_OK);
      if (thrown) {
        assert_int_equal(msq_error_host_code(), 0);
        assert_non_null(std::strstr(msq_error_message(), "no ink"));
        has_thrown = true;
        ++stops;
      }
      output.clear();
      assert_ok(call(output));
      assert_true(output == right);
    }
    if (!has_thrown) return stops;
  }
}

msq_context* make_context() {
  msq_context_def def;
  assert_ok(msq_context_def_init(&def, sizeof def));
  def.threads = 4;
  msq_context* made = nullptr;
  assert_ok(msq_context_create(&def, &made));
  return made;
}

/// Takes over the handles.
msq_model* make_model(msq_context* context, msq_shape* shape, msq_structure* structure) {
  if (!shape) {
    const double min[3] = {0, 0, 0}, max[3] = {4, 4, 4};
    assert_ok(msq_shape_from_box(context, min, max, &shape));
  }
  msq_scale_def scales[2] = {};
  scales[0].shape = shape;
  scales[1].structure = structure;
  msq_model_def def;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = structure ? 2 : 1;
  def.scale_size = sizeof scales[0];
  msq_model* made = nullptr;
  assert_ok(msq_model_create(context, &def, &made));
  msq_shape_release(shape);
  msq_structure_release(structure);
  return made;
}

/// Throws in each kind of call that queries a model. Returns how many calls failed.
int stops_of_model(msq_context* context, const msq_model* model, Thrower& thrower) {
  constexpr uint64_t side = 9;
  std::vector<double> coordinates;
  for (int i = 0; i < 900; ++i) coordinates.push_back(std::fmod(0.1 + 0.61803398875 * i, 4));
  msq_points_def array, grid;
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = coordinates.data();
  array.count = 300;
  assert_ok(msq_points_def_init(&grid, sizeof grid));
  grid.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = 0.1;
    grid.spacing[axis] = 0.43;
    grid.counts[axis] = side;
  }
  int stops = 0;
  for (const msq_points_def* points : {&array, &grid})
    stops += count_stops(thrower, [&](Output& output) {
      assert_ok(msq_cache_clear(context));
      output.assign(points == &grid ? side * side * side : array.count, 0);
      return msq_set_membership(model, points, nullptr, output.data(), output.size(), nullptr);
    });
  stops += count_stops(thrower, [&](Output& output) {
    std::vector<double> distances(array.count);
    assert_ok(msq_cache_clear(context));
    const msq_status status =
        msq_set_distance(model, &array, nullptr, distances.data(), array.count, nullptr);
    append(output, distances);
    return status;
  });
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = def.pitch[1] = 0.1;
  def.layer_height = 0.5;
  msq_slicer* slicer = nullptr;
  assert_ok(msq_slicer_create(model, &def, &slicer));
  stops += count_stops(thrower, [&](Output& output) {
    assert_ok(msq_cache_clear(context));
    return msq_slicer_run(
        slicer, 0, 8,
        [](void* to, const msq_layer* layer) -> int32_t {
          auto& all = *static_cast<Output*>(to);
          all.insert(all.end(), layer->data, layer->data + layer->stride * layer->height);
          return 0;
        },
        &output, nullptr);
  });
  msq_slicer_release(slicer);
  return stops;
}

bool is_solid(const double* p) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) squared += (p[axis] - 0.5) * (p[axis] - 0.5);
  return squared >= 0.16;
}

int32_t points_inside(void*, const msq_host_points* points, uint8_t* inside) {
  at_inside();
  for (uint64_t i = 0; i < points->count; ++i) inside[i] = is_solid(points->positions + 3 * i);
  return 0;
}

int32_t points_distance(void*, const msq_host_points* points, double* distances) {
  at_distance();
  for (uint64_t i = 0; i < points->count; ++i) distances[i] = 0;
  return 0;
}

int32_t box_class(void*, const double*, const double*, int32_t* answer) {
  at_box();
  *answer = MSQ_BOX_MIXED;
  return 0;
}

/// What it has written when it throws is nobody's.
int32_t build_cell(void*, const int32_t*, void** data, uint64_t* bytes) {
  *data = &not_there;
  *bytes = 64;
  at_build();
  *data = new char(1);
  ++cells;
  return 0;
}

int32_t evaluate_cell(void*, const void* data, const msq_host_points* points, uint8_t* inside) {
  at_evaluate();
  for (uint64_t i = 0; i < points->count; ++i)
    inside[i] = *static_cast<const char*>(data) == 1 && is_solid(points->positions + 3 * i);
  return 0;
}

/// Always throws, when its work is done.
void free_cell(void*, void* data) {
  if (data == &not_there) {
    frees_what_is_not_there = true;
    return;
  }
  delete static_cast<char*>(data);
  --cells;
  throw std::runtime_error("dropped");
}

void host_shapes(void**) {
  for (const int32_t concurrent : {0, 1}) {
    msq_context* context = make_context();
    msq_host_shape_def def;
    assert_ok(msq_host_shape_def_init(&def, sizeof def));
    def.concurrent = concurrent;
    for (double& max : def.max) max = 4;
    for (double& min : def.min) min = 0;
    def.inside = [](void*, const double* points, uint64_t count, uint8_t* inside) -> int32_t {
      at_inside();
      for (uint64_t i = 0; i < count; ++i) inside[i] = points[3 * i] < points[3 * i + 1];
      return 0;
    };
    def.distance = [](void*, const double*, uint64_t count, double* distances) -> int32_t {
      at_distance();
      for (uint64_t i = 0; i < count; ++i) distances[i] = 0;
      return 0;
    };
    msq_shape* shape = nullptr;
    assert_ok(msq_shape_from_host(context, &def, &shape));
    msq_model* model = make_model(context, shape, nullptr);
    assert_true(stops_of_model(context, model, at_inside) > 0);
    assert_true(stops_of_model(context, model, at_distance) > 0);
    msq_model_release(model);
    msq_context_release(context);
  }
}

void host_points_structures(void**) {
  for (const int32_t concurrent : {0, 1}) {
    msq_context* context = make_context();
    msq_host_structure_def def;
    assert_ok(msq_host_structure_def_init(&def, sizeof def));
    def.concurrent = concurrent;
    def.inside = points_inside;
    def.distance = points_distance;
    def.box = box_class;
    msq_structure* structure = nullptr;
    assert_ok(msq_structure_host(context, &def, &structure));
    msq_model* model = make_model(context, nullptr, structure);
    assert_true(stops_of_model(context, model, at_inside) > 0);
    assert_true(stops_of_model(context, model, at_distance) > 0);
    assert_true(stops_of_model(context, model, at_box) > 0);
    msq_model_release(model);
    msq_context_release(context);
  }
}

void host_cells(void**) {
  for (const int32_t concurrent : {0, 1}) {
    msq_context* context = make_context();
    msq_host_structure_def def;
    assert_ok(msq_host_structure_def_init(&def, sizeof def));
    def.concurrent = concurrent;
    def.build_cell = build_cell;
    def.evaluate_cell = evaluate_cell;
    def.free_cell = free_cell;
    msq_structure* structure = nullptr;
    assert_ok(msq_structure_host(context, &def, &structure));
    msq_model* model = make_model(context, nullptr, structure);
    assert_true(stops_of_model(context, model, at_build) > 0);
    assert_true(stops_of_model(context, model, at_evaluate) > 0);
    assert_true(cells > 0);
    msq_model_release(model);
    msq_context_release(context);
    assert_int_equal(cells, 0);
    assert_false(frees_what_is_not_there);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(host_shapes),
      cmocka_unit_test(host_points_structures),
      cmocka_unit_test(host_cells),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
