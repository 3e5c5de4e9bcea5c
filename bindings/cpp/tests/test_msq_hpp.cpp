// SPDX-License-Identifier: Apache-2.0
// msq.hpp against msq.h: lives of objects, errors, callbacks that throw, ranges.
#include <msq.hpp>

#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "msq_test.h"
#include "thrown_by.h"

namespace {

msq::Shape cube(const msq::Context& context) {
  return msq::Shape::box(context, {0, 0, 0}, {10, 10, 10});
}

msq::Structure foam(const msq::Context& context, msq_param radius) {
  msq::FoamDef def;
  for (double& size : def.grid.cell_size) size = 2;
  def.radius = radius;
  return msq::Structure::foam(context, def);
}

msq::Model foam_model(const msq::Context& context) {
  return {context, {cube(context), foam(context, msq::param(0.3))}};
}

msq::Slicer slicer(const msq::Model& model, double pitch = 0.25) {
  msq::SlicerDef def;
  def.output = MSQ_LAYER_BYTES;
  def.pitch[0] = def.pitch[1] = pitch;
  def.layer_height = 0.5;
  return {model, def};
}

void handles_count_references(void**) {
  msq::Shape kept;
  assert_false(static_cast<bool>(kept));
  {
    const msq::Context context;
    const msq::Shape shape = cube(context);
    msq::Shape copy = shape, moved = std::move(copy);
    assert_true(copy.get() == nullptr);
    assert_ptr_equal(moved.get(), shape.get());
    kept = moved;
    const msq::Shape& same = kept;
    kept = same;
  }
  assert_true(std::abs(kept.info().volume - 1000) < 1e-9);
}

void errors_have_status_and_message(void**) {
  const msq::Context context;
  try {
    msq::Shape::sphere(context, {0, 0, 0}, -1);
    fail_msg("a radius of -1 was taken");
  } catch (const msq::Error& error) {
    assert_int_equal(error.status(), MSQ_E_ARGUMENT);
    assert_non_null(std::strstr(error.what(), "-1"));
  }
  const msq::Job job = msq::Job::create();
  job.cancel();
  std::vector<uint8_t> inside(1);
  const double point[3] = {1, 1, 1};
  bool is_cancelled = false;
  try {
    foam_model(context).membership(msq::points(point), inside, msq::QueryDef(), job);
  } catch (const msq::Cancelled&) {
    is_cancelled = true;
  }
  assert_true(is_cancelled);
  assert_true(job.progress() < 1);
}

void sets_points_and_layers_agree(void**) {
  const msq::Context context;
  const msq::Model model = foam_model(context);
  const msq::Slicer layers = slicer(model);
  const msq_slicer_report info = layers.info();
  std::vector<uint8_t> all;
  std::vector<double> heights;
  layers.run([&](const msq_layer& layer) {
    all.insert(all.end(), layer.data, layer.data + layer.stride * layer.height);
    heights.push_back(layer.z);
  });
  std::vector<uint8_t> ranged;
  for (const msq::Layer& layer : layers.layers()) {
    assert_true(layer.z == heights[layer.index]);
    ranged.insert(ranged.end(), layer.bytes.begin(), layer.bytes.end());
  }
  assert_true(all == ranged);
  assert_int_equal(heights.size(), info.layer_count);

  const msq::PointsDef grid =
      msq::grid({info.origin[0], info.origin[1], heights[0]}, {info.pitch[0], info.pitch[1], 1},
                {info.width, info.height, 1});
  std::vector<uint8_t> inside(info.width * info.height);
  model.membership(grid, inside);
  const std::vector<double> triples = msq::generate(grid, 0, inside.size());
  for (uint32_t j = 0; j < info.height; ++j)
    for (uint32_t i = 0; i < info.width; ++i) {
      const size_t at = j * info.width + i;
      assert_int_equal(inside[at], all[j * info.stride + i] != 0);
      if (at % 17 == 0)
        assert_int_equal(model.inside({triples[3 * at], triples[3 * at + 1], triples[3 * at + 2]}),
                         inside[at]);
    }
}

struct Odd : std::exception {
  const char* what() const noexcept override { return "odd"; }
};

uint64_t taken = 0;
void take(const msq_layer&) {
  ++taken;
}
int32_t stop_at_two(const msq_layer& layer) noexcept {
  return layer.index == 2 ? -7 : 0;
}
void take_struts(const msq_strut*, uint64_t count) {
  taken += count;
}
void take_slab(const msq_surface_slab& slab) {
  taken += slab.vertex_count;
}

struct Counter {
  uint64_t count = 0;
  void operator()(const msq_layer&) { ++count; }
};

void callbacks_are_anything_that_can_be_called(void**) {
  const msq::Context context;
  const msq::Slicer layers = slicer(foam_model(context));
  const uint64_t count = layers.info().layer_count;
  taken = 0;
  layers.run(take);
  assert_int_equal(taken, count);
  layers.run(&take);
  layers.run(0, 1, take);
  assert_int_equal(taken, 2 * count + 1);
  assert_non_null(std::strstr(thrown_by([&] { layers.run(stop_at_two); }).c_str(), "-7"));

  Counter counter;
  layers.run(counter);
  assert_int_equal(counter.count, count);
  layers.run(Counter());
  const auto constant = [&](const msq_layer&) { ++taken; };
  layers.run(constant);
  layers.run(std::function<void(const msq_layer&)>(take));
  assert_int_equal(taken, 4 * count + 1);

  taken = 0;
  msq::StrutsDef def;
  for (double& max : def.max) max = 10;
  foam(context, msq::param(0.3)).struts(context, def, take_struts);
  assert_true(taken > 1000);
  taken = 0;
  msq::SurfaceDef surface;
  surface.pitch = 1;
  msq::Model(context, {cube(context)}).surface_mesh(surface, take_slab);
  assert_true(taken > 0);
}

/// The message of the std::invalid_argument that a call throws.
template <class Call>
std::string refusal_of(Call&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  fail_msg("nothing was refused");
  return "";
}

void arrays_of_wrong_lengths_are_refused(void**) {
  const msq::Context context;
  const std::vector<double> numbers(10);
  const msq::Span<const double> nine(numbers.data(), 9);
  assert_string_equal(refusal_of([&] { msq::points(numbers); }).c_str(),
                      "msq::points: there are 10 coordinates; there must be 3 per point");
  assert_int_equal(msq::points(nine).count, 3);

  // A tetrahedron, and one number or index more.
  const std::vector<double> longer = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5};
  const std::vector<float> floats(longer.begin(), longer.end());
  const std::vector<uint32_t> indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 0};
  const msq::Span<const double> vertices(longer.data(), 12);
  const msq::Span<const uint32_t> triangles(indices.data(), 12);
  assert_true(msq::Shape::from_mesh(context, vertices, triangles).info().volume > 0.16);
  const char* per_vertex =
      "msq::Shape::from_mesh: there are 13 coordinates; there must be 3 per vertex";
  assert_string_equal(
      refusal_of([&] { msq::Shape::from_mesh(context, longer, triangles); }).c_str(), per_vertex);
  assert_string_equal(
      refusal_of([&] { msq::Shape::from_mesh(context, floats, triangles); }).c_str(), per_vertex);
  assert_string_equal(
      refusal_of([&] { msq::Shape::from_mesh(context, vertices, indices); }).c_str(),
      "msq::Shape::from_mesh: there are 13 indices; there must be 3 per triangle");

  const msq::Field field = msq::Field::gradient(context, {0, 0, 0}, 0, {1, 0, 0}, 1);
  const double curve[3] = {0, 0, 1};
  assert_string_equal(refusal_of([&] { msq::Field::map(context, field, curve); }).c_str(),
                      "msq::Field::map: there are 3 numbers; there must be 2 per pair");
  assert_string_equal(refusal_of([&] {
                        msq::Field::grid(context, numbers, {2, 2, 3}, {0, 0, 0}, {1, 1, 1});
                      }).c_str(),
                      "msq::Field::grid: there are 10 values; size has 2 x 2 x 3");
  assert_string_equal(refusal_of([&] { msq::period(0, numbers, nine); }).c_str(),
                      "msq::period: there are 10 positions and 9 cell_sizes");
}

void onsets_have_gradients(void**) {
  const msq::Context context;
  const msq::Structure structure = foam(context, msq::param(0.3));
  const double point[3] = {1, 1.3, 0.7};
  std::vector<double> onset(1), gradient(3), shorter(2);
  structure.onset(context, msq::points(point), MSQ_ONSET_PLAIN, onset, gradient);
  double moved[3], other[1];
  for (size_t axis = 0; axis < 3; ++axis) moved[axis] = point[axis] + 1e-4 * gradient[axis];
  structure.onset(context, msq::points(moved), MSQ_ONSET_PLAIN, other);
  assert_true(other[0] > onset[0]);
  const std::string message = thrown_by(
      [&] { structure.onset(context, msq::points(point), MSQ_ONSET_PLAIN, onset, shorter); });
  assert_non_null(std::strstr(message.c_str(), "gradient_count is 2"));
}

void exceptions_of_callbacks_come_through(void**) {
  const msq::Context context;
  const msq::Slicer layers = slicer(foam_model(context));
  assert_string_equal(thrown_by([&] {
                        layers.run([](const msq_layer& layer) {
                          if (layer.index == 2) throw Odd();
                        });
                      }).c_str(),
                      "odd");
  // An own code, and the next run is whole.
  try {
    layers.run([](const msq_layer&) -> int32_t { return -7; });
    fail_msg("a code of -7 was ignored");
  } catch (const msq::Error& error) {
    assert_int_equal(error.status(), MSQ_E_HOST);
    assert_int_equal(error.host_code(), -7);
  }
  uint64_t count = 0;
  layers.run([&](const msq_layer&) { ++count; });
  assert_int_equal(count, layers.info().layer_count);
}

void exceptions_of_objects_come_through(void**) {
  const msq::Context context;
  msq::HostFieldDef def;
  def.low = 0.1;
  def.high = 0.5;
  def.lipschitz = 0.1;
  def.concurrent = 1;
  std::atomic<bool> throws{false};
  const msq::Field radius =
      msq::Field::host(context, def, [&](const double*, uint64_t count, double* values) {
        if (throws) throw Odd();
        std::fill(values, values + count, 0.3);
      });
  const msq::Model model(context, {cube(context), foam(context, msq::param(radius))});
  const msq::Model same = foam_model(context);
  const std::vector<uint8_t> layer = slicer(model).layer(3);
  assert_true(layer == slicer(same).layer(3));
  throws = true;
  for (int i = 0; i < 3; ++i)
    assert_string_equal(thrown_by([&] { slicer(model, 0.1).layer(3); }).c_str(), "odd");
  // On each thread its own.
  std::vector<std::thread> threads;
  std::atomic<int> odd{0};
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      try {
        model.inside({1, 1, 1});
      } catch (const Odd&) {
        ++odd;
      }
    });
  for (std::thread& thread : threads) thread.join();
  assert_int_equal(odd.load(), 4);
  throws = false;
  assert_true(layer == slicer(model).layer(3));
}

void callbacks_are_freed_with_their_object(void**) {
  const auto count = std::make_shared<int>(0);
  {
    const msq::Context context;
    msq::HostShapeDef def;
    for (size_t axis = 0; axis < 3; ++axis) def.min[axis] = 0, def.max[axis] = 1;
    const msq::Shape shape =
        msq::Shape::host(context, def, [count](const double*, uint64_t n, uint8_t* inside) {
          std::fill(inside, inside + n, uint8_t{1});
        });
    assert_int_equal(count.use_count(), 2);
    def.max[0] = -1;
    thrown_by(
        [&] { msq::Shape::host(context, def, [count](const double*, uint64_t, uint8_t*) {}); });
    assert_int_equal(count.use_count(), 2);
    assert_true(msq::Model(context, {shape}).inside({0.5, 0.5, 0.5}));
  }
  assert_int_equal(count.use_count(), 1);
}

void structures_of_the_host(void**) {
  const msq::Context context;
  msq::HostStructureDef def;
  for (double& size : def.grid.cell_size) size = 1;
  msq::StructureCallbacks callbacks;
  callbacks.build_cell = [](const int32_t* cell, void** data, uint64_t* bytes) {
    *data = new int32_t(cell[0]);
    *bytes = sizeof(int32_t);
  };
  callbacks.evaluate_cell = [](const void* data, const msq_host_points& points, uint8_t* inside) {
    for (uint64_t i = 0; i < points.count; ++i)
      inside[i] = *static_cast<const int32_t*>(data) % 2 == 0;
  };
  callbacks.free_cell = [](void* data) { delete static_cast<int32_t*>(data); };
  callbacks.box = [](const double*, const double*) -> int32_t { return MSQ_BOX_MIXED; };
  const msq::Model model(context, {cube(context), msq::Structure::host(context, def, callbacks)});
  assert_true(model.inside({0.5, 0.5, 0.5}));
  assert_false(model.inside({1.5, 0.5, 0.5}));

  msq::HostFunctionDef function;
  function.kind = MSQ_FUNCTIONAL_NETWORK;
  for (double& size : function.grid.cell_size) size = 10;
  function.level = msq::param(3);  // of angles from 0 to 2 pi
  function.lipschitz = 1;
  const msq::Model half(
      context, {cube(context),
                msq::Structure::host_function(
                    context, function, [](const double* points, uint64_t count, double* values) {
                      for (uint64_t i = 0; i < count; ++i) values[i] = points[3 * i];
                    })});
  assert_true(half.inside({4, 1, 1}) != half.inside({6, 1, 1}));
}

/// Membership of points in the cube.
std::vector<uint8_t> inside_cube(const msq::Context& context, const msq::Structure& structure) {
  std::vector<uint8_t> inside(30 * 30 * 30);
  const msq::Model model(context, {cube(context), structure});
  model.membership(msq::grid({0.1, 0.1, 0.1}, {0.33, 0.33, 0.33}, {30, 30, 30}), inside);
  return inside;
}

size_t differing(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), size_t{0}, std::plus<>(),
                            std::not_equal_to<>());
}

void cells_vary(void**) {
  const msq::Context context;
  msq::LatticeDef def;
  for (double& size : def.grid.cell_size) size = 2.5;
  def.radius = msq::param(0.4);
  const auto inside = [&] { return inside_cube(context, msq::Structure::lattice(context, def)); };
  const std::vector<uint8_t> plain = inside();

  def.grid.cell_size[0] = 7;  // ignored: the period has its own size along x
  const std::vector<double> positions = {0, 5}, even = {2.5, 2.5}, graded = {2.5, 1.5};
  const msq::PeriodDef same = msq::period(0, positions, even);
  def.period = &same;
  assert_true(differing(inside(), plain) < 8);
  const msq::PeriodDef period = msq::period(0, positions, graded);
  def.period = &period;
  assert_true(differing(inside(), plain) > 100);
  assert_non_null(
      std::strstr(thrown_by([&] { msq::period(0, positions, {}); }).c_str(), "2 positions and 0"));

  def.period = nullptr;
  msq::WarpDef warp;
  def.warp = &warp;
  assert_non_null(std::strstr(thrown_by(inside).c_str(), "warp.count is 0"));
  warp.count = 4;  // a quarter of a turn: y takes the place of x
  warp.inner_radius = 1;
  warp.shear_along = 0.5;
  for (size_t axis = 0; axis < 3; ++axis) def.grid.origin[axis] = 5;
  const msq::Model model(context, {cube(context), msq::Structure::lattice(context, def)});
  size_t found = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = std::fmod(i * 0.618034, 1) * 9 - 4.5, y = std::fmod(i * 0.754878, 1) * 9 - 4.5;
    const double z = 5 + std::fmod(i * 0.569840, 1) * 4;
    const bool here = model.inside({5 + x, 5 + y, z}), there = model.inside({5 - y, 5 + x, z});
    found += here;
    assert_true(here == there);
  }
  assert_true(found > 10 && found < 990);

  msq::FoamDef foam;
  for (double& size : foam.grid.cell_size) size = 2;
  foam.radius = msq::param(0.3);
  const auto of_foam = [&] { return inside_cube(context, msq::Structure::foam(context, foam)); };
  const std::vector<uint8_t> round = of_foam();
  for (double& stretch : foam.stretch) stretch = 2;  // only the proportions count
  assert_int_equal(differing(of_foam(), round), 0);
  foam.stretch[2] = 6;
  assert_true(differing(of_foam(), round) > 100);
  foam.stretch[2] = 2;
  foam.weight = 2;
  assert_true(differing(of_foam(), round) > 100);
}

void cells_by_samples(void**) {
  const msq::Context context;
  msq::LatticeDef def;
  def.radius = msq::param(0.4);
  for (double& size : def.grid.cell_size) size = 2.5;
  const auto inside = [&] { return inside_cube(context, msq::Structure::lattice(context, def)); };
  const std::vector<uint8_t> plain = inside();
  // A map of the same cells, and one of larger ones.
  const auto coordinate = [&](int axis, double cell_size) {
    std::vector<double> values;
    for (int i = 0; i < 216; ++i) {
      const int at[3] = {i % 6, i / 6 % 6, i / 36};
      values.push_back((4 * at[axis] - 5) / cell_size);
    }
    return msq::Field::grid(context, values, {6, 6, 6}, {-5, -5, -5}, {4, 4, 4});
  };
  const msq::Field u = coordinate(0, 2.5), v = coordinate(1, 2.5), w = coordinate(2, 2.5);
  const msq::WarpDef same = msq::sampled_warp(u, v, w);
  def.warp = &same;
  assert_true(differing(inside(), plain) < 8);
  const msq::Field larger = coordinate(2, 4);
  const msq::WarpDef other = msq::sampled_warp(u, v, larger);
  def.warp = &other;
  assert_true(differing(inside(), plain) > 100);
  const msq::WarpDef flat = msq::sampled_warp(u, v, v);
  def.warp = &flat;
  assert_non_null(std::strstr(thrown_by(inside).c_str(), "folds"));
  assert_non_null(std::strstr(
      thrown_by([&] {
        msq::Field::grid(context, std::vector<double>(7), {2, 2, 2}, {0, 0, 0}, {1, 1, 1});
      }).c_str(),
      "there are 7 values"));
}

void plates_and_fillets(void**) {
  const msq::Context context;
  msq::PlateLatticeDef def;
  for (double& size : def.grid.cell_size) size = 2;
  def.thickness = msq::param(0.4);
  const msq::Structure plates = msq::Structure::plate_lattice(context, def);
  const msq::Model model(context, {cube(context), plates});
  assert_true(model.inside({1, 1, 1.9}) && !model.inside({1, 1, 1.7}));  // 0.1 and 0.3 from a plate
  const msq::Structure struts = foam(context, msq::param(0.3));
  const auto plain =
      inside_cube(context, msq::Structure::boolean(MSQ_BOOLEAN_UNION, {plates, struts}));
  const auto smooth = inside_cube(
      context, msq::Structure::smooth_boolean(MSQ_BOOLEAN_UNION, plates, struts, msq::param(0.5)));
  assert_true(differing(plain, smooth) > 0);
  for (size_t i = 0; i < plain.size(); ++i) assert_true(smooth[i] >= plain[i]);
}

void contexts_have_lambdas(void**) {
  const auto warned = std::make_shared<int>(0);
  std::atomic<uint64_t> tasks{0};
  {
    msq::ContextDef def;
    def.threads = 4;
    const msq::Context context(
        def,
        [warned](int32_t code, const char*) {
          if (code == MSQ_WARNING_COARSE_PITCH) ++*warned;
          throw Odd();  // dropped
        },
        [&](uint64_t count, const std::function<void(uint64_t)>& body) {
          for (uint64_t i = 0; i < count; ++i) body(i);
          tasks += count;
        });
    const msq::Model model = foam_model(context);
    slicer(model, 1);
    assert_int_equal(*warned, 1);
    slicer(model, 0.01).run([](const msq_layer&) {});
    assert_true(tasks > 1);
    assert_true(context.memory().peak_bytes > 0);
  }
  assert_int_equal(warned.use_count(), 1);
}

void everything_else_is_reached(void**) {
  const msq::Context context;
  const msq::Model model = foam_model(context);
  msq::ContoursDef contours;
  contours.tolerance = 0.05;
  contours.pitch = 0.25;
  const msq_contours_report outline = model.contours(5.1, contours).info();
  assert_true(outline.ring_count > 0);

  double volume = 0;
  std::vector<double> vertices;
  msq::SurfaceDef surface;
  surface.pitch = 1;
  msq::Model(context, {cube(context)}).surface_mesh(surface, [&](const msq_surface_slab& slab) {
    vertices.insert(vertices.end(), slab.vertices, slab.vertices + 3 * slab.vertex_count);
    for (uint64_t t = 0; t < slab.triangle_count; ++t) {
      const double* p[3];
      for (size_t k = 0; k < 3; ++k) p[k] = &vertices[3 * size_t{slab.triangles[3 * t + k]}];
      for (size_t k = 0; k < 3; ++k)
        volume += p[0][k] *
                  (p[1][(k + 1) % 3] * p[2][(k + 2) % 3] - p[1][(k + 2) % 3] * p[2][(k + 1) % 3]);
    }
  });
  assert_true(std::abs(volume / 6 - 1000) < 1);

  const msq::PointsDef sample = msq::stratified({0, 0, 0}, {1, 1, 1}, {10, 10, 10}, 2, 1);
  const msq_estimate fraction = model.volume_fraction(sample);
  const auto calibrated = foam(context, msq::param(0.3)).calibrate(context, fraction.value, 16);
  assert_true(std::abs(calibrated.report.parameter - 0.3) < 0.05);
  assert_int_equal(calibrated.parameters.size(), 16);

  uint64_t struts = 0;
  msq::StrutsDef def;
  for (double& max : def.max) max = 10;
  const msq::Structure structure = foam(context, msq::param(0.3));
  structure.struts(context, def, [&](const msq_strut*, uint64_t count) { struts += count; });
  assert_int_equal(structure.strut_graph(context, def).info().strut_count, struts);
  assert_true(struts > 1000);

  const msq::UnitCell cell([] {
    msq::UnitCellDef named;
    named.unit_cell = MSQ_UNIT_CELL_BCC;
    return named;
  }());
  assert_int_equal(cell.nodes.size(), 27);
  assert_int_equal(cell.struts.size(), 16);

  const msq::Camera camera = model.fit_camera({1, 1, -1}, {0, 0, 1}, 16, 16);
  const auto [origin, direction] = msq::camera_ray(camera, 16, 16, {8, 8});
  msq::RaysDef rays;
  rays.coordinate_type = MSQ_FLOAT64;
  rays.count = 1;
  rays.origins = origin.data();
  rays.directions = direction.data();
  std::vector<msq_ray_hit> hits(1);
  model.cast(rays, hits);
  assert_true(hits[0].t > 0);
  if (msq::build_info().with_xxhash) assert_true(model.hash() == foam_model(context).hash());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(handles_count_references),
      cmocka_unit_test(errors_have_status_and_message),
      cmocka_unit_test(sets_points_and_layers_agree),
      cmocka_unit_test(callbacks_are_anything_that_can_be_called),
      cmocka_unit_test(arrays_of_wrong_lengths_are_refused),
      cmocka_unit_test(onsets_have_gradients),
      cmocka_unit_test(exceptions_of_callbacks_come_through),
      cmocka_unit_test(exceptions_of_objects_come_through),
      cmocka_unit_test(callbacks_are_freed_with_their_object),
      cmocka_unit_test(structures_of_the_host),
      cmocka_unit_test(cells_vary),
      cmocka_unit_test(cells_by_samples),
      cmocka_unit_test(plates_and_fillets),
      cmocka_unit_test(contexts_have_lambdas),
      cmocka_unit_test(everything_else_is_reached),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
