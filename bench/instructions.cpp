// SPDX-License-Identifier: Apache-2.0
// One kernel on a small input, on one thread and with AVX2, for scripts/count_instructions: it
// counts the instructions of msq_measured() alone.
//
// usage: instructions KERNEL | --list
#include <hwy/highway.h>

#include <cstring>
#include <string>

#include "base/random.h"
#include "foam_rays.h"
#include "rippled_torus.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/walls/face_brick.h"

#if MSQ_WITH_PNG
#include "png_stream.h"
#endif

#if defined(__GNUC__) && !defined(__clang__)
// No copy of it for certain arguments, which would have another name.
#define MSQ_ITSELF __attribute__((noipa))
#else
#define MSQ_ITSELF __attribute__((noinline))
#endif

/// What is counted. callgrind finds it by its name.
extern "C" MSQ_ITSELF void msq_measured(const std::function<void()>& work) {
  work();
}

namespace {

using bench::check;

constexpr uint32_t side = 256;  // pixels

std::vector<double> random_points(size_t count) {
  std::vector<double> coordinates(3 * count);
  for (size_t i = 0; i < coordinates.size(); ++i)
    coordinates[i] = static_cast<double>(msq::splitmix_output(1, i) >> 11) * 0x1p-53;
  return coordinates;
}

msq_model* make_lattice(msq_context* context, int cells, bool is_turned, bool is_graded = false) {
  msq_lattice_def def;
  check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_OCTET;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.08 / cells;
  if (is_turned) bench::turn(def.grid);
  msq_field* gradient = nullptr;
  if (is_graded) {
    const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    check(msq_field_gradient(context, low, 0.04 / cells, high, 0.12 / cells, &gradient));
    def.radius = {0, gradient};
  }
  msq_structure* lattice;
  check(msq_structure_lattice(context, &def, &lattice));
  msq_field_release(gradient);
  return bench::make_model(context, bench::make_cube(context), lattice);
}

msq_model* make_gyroid(msq_context* context, int cells, bool is_turned) {
  msq_functional_def def;
  check(msq_functional_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.3;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  if (is_turned) bench::turn(def.grid);
  msq_structure* gyroid;
  check(msq_structure_functional(context, &def, &gyroid));
  return bench::make_model(context, bench::make_cube(context), gyroid);
}

/// A foam of walls of 0.1 cell.
msq_model* make_walls(msq_context* context, int cells) {
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.wall_thickness.value = 0.1 / cells;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  return bench::make_model(context, bench::make_cube(context), foam);
}

/// A foam whose radius is an expression.
msq_model* make_waving_foam(msq_context* context, int cells) {
  msq_expression_field_def waves;
  check(msq_expression_field_def_init(&waves, sizeof waves));
  const msq_named_value parameters[] = {{"cells", static_cast<double>(cells)}};
  waves.expression = "(0.1 + 0.05*sin(5*x)*cos(4*y + 3*z)) / cells";
  waves.parameters = parameters;
  waves.parameter_count = 1;
  waves.high = 0.15 / cells;
  msq_field* radius;
  check(msq_field_expression(context, &waves, &radius));
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius = {0, radius};
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  msq_field_release(radius);
  return bench::make_model(context, bench::make_cube(context), foam);
}

msq_model* make_waves(msq_context* context) {
  msq_waves_def def;
  check(msq_waves_def_init(&def, sizeof def));
  def.count = 100;
  for (double& size : def.grid.cell_size) size = 1.0 / 8;
  msq_structure* waves;
  check(msq_structure_waves(context, &def, &waves));
  return bench::make_model(context, bench::make_cube(context), waves);
}

/// Beams between random places, with two radii.
msq_model* make_beams(msq_context* context) {
  constexpr size_t count = 4000;
  std::vector<double> nodes = random_points(2 * count), radii(2 * count);
  std::vector<uint32_t> beams(2 * count);
  for (size_t i = 0; i < 2 * count; ++i) {
    beams[i] = static_cast<uint32_t>(i);
    radii[i] = i % 2 ? 0.004 : 0.008;
  }
  for (size_t i = 1; i < 2 * count; i += 2)  // short ones
    for (size_t k = 0; k < 3; ++k) {
      const double a = nodes[3 * (i - 1) + k];
      nodes[3 * i + k] = a + 0.1 * (nodes[3 * i + k] - a);
    }
  msq_beams_def def;
  check(msq_beams_def_init(&def, sizeof def));
  def.nodes = nodes.data();
  def.node_count = 2 * count;
  def.beams = beams.data();
  def.beam_count = count;
  def.radii = radii.data();
  msq_structure* structure;
  check(msq_structure_beams(context, &def, &structure, nullptr));
  return bench::make_model(context, bench::make_cube(context), structure);
}

/// Around the cube's middle and twisted, or by a map of samples.
msq_model* make_warped_gyroid(msq_context* context, int32_t kind) {
  constexpr int cells = 9;
  bench::SampledCells map(context, cells);
  msq_warp_def warp = bench::warp_of(kind, cells);
  if (kind == MSQ_WARP_SAMPLED) map.set(warp);
  if (kind == MSQ_WARP_CYLINDRICAL) warp.shear_along = 0.5;
  msq_functional_def def;
  check(msq_functional_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.3;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  bench::put_in_middle(def.grid);
  def.warp = &warp;
  msq_structure* gyroid;
  check(msq_structure_functional(context, &def, &gyroid));
  return bench::make_model(context, bench::make_cube(context), gyroid);
}

msq_model* make_part(msq_context* context) {
  return bench::make_model(context, bench::make_shape(context, bench::rippled_torus(100, 50)),
                           nullptr);
}

/// Layers as bits, after one run that fills the caches.
void slice(msq_model* model, uint64_t layers) {
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(side));
  bench::Reader reader;
  const auto run = [&] {
    check(msq_slicer_run(slicer, side / 8, layers, bench::Reader::take, &reader, nullptr));
  };
  run();
  msq_measured(run);
  msq_slicer_release(slicer);
}

void ask_membership(msq_model* model, size_t count) {
  const std::vector<double> coordinates = random_points(count);
  std::vector<uint8_t> inside(count);
  msq_points_def points;
  check(msq_points_def_init(&points, sizeof points));
  points.coordinates = coordinates.data();
  points.count = count;
  const auto run = [&] {
    check(msq_set_membership(model, &points, nullptr, inside.data(), count, nullptr));
  };
  run();
  msq_measured(run);
}

void ask_distances(msq_model* model, size_t count) {
  const std::vector<double> coordinates = random_points(count);
  std::vector<double> distances(count);
  msq_points_def points;
  check(msq_points_def_init(&points, sizeof points));
  points.coordinates = coordinates.data();
  points.count = count;
  const auto run = [&] {
    check(msq_set_distance(model, &points, nullptr, distances.data(), count, nullptr));
  };
  run();
  msq_measured(run);
}

void ask_points(msq_model* model, size_t count) {
  const std::vector<double> coordinates = random_points(count);
  const auto run = [&] {
    for (size_t i = 0; i < count; ++i) {
      int32_t is_inside;
      check(msq_point_membership(model, &coordinates[3 * i], nullptr, &is_inside));
    }
  };
  run();
  msq_measured(run);
}

void render(msq_model* model, uint32_t pixels) {
  bench::Picture picture(pixels);
  const msq_camera camera = bench::fit_camera(model, {-1, -1, -1}, pixels);
  const auto run = [&] { picture.render(model, camera); };
  run();
  msq_measured(run);
}

void outline(msq_model* model) {
  msq_contours_def def;
  check(msq_contours_def_init(&def, sizeof def));
  def.type = MSQ_INT64;
  def.units = 1e6;
  def.pitch = 1.0 / side;
  def.tolerance = 0.25 / side;
  const auto run = [&] {
    msq_contours* contours;
    check(msq_layer_contours(model, 0.503, &def, &contours, nullptr));
    msq_contours_release(contours);
  };
  run();
  msq_measured(run);
}

void build_edges() {
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  msq_measured([&] {
    for (int x = 0; x < 4 * msq::EdgeBrick::side; x += msq::EdgeBrick::side)
      msq::EdgeBrick(seeds, {x, 0, 0});
  });
}
void build_faces() {
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  msq_measured([&] {
    for (int x = 0; x < 4 * msq::FaceBrick::side; x += msq::FaceBrick::side)
      msq::FaceBrick(seeds, {x, 0, 0}, false);
  });
}

void read_part() {
  msq_context* const context = bench::make_context(1);
  const bench::MeshArrays mesh = bench::rippled_torus(100, 50);
  msq_shape* shape = nullptr;
  msq_measured([&] { shape = bench::make_shape(context, mesh); });
  msq_shape_release(shape);
  msq_context_release(context);
}

#if MSQ_WITH_PNG
/// A layer of a foam, as bits.
void encode(msq_model* model, int level) {
  constexpr uint32_t width = 1024;
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(width));
  std::vector<uint8_t> pixels(size_t{width} * width / 8), rows, stream;
  check(msq_slice_layer(slicer, width / 2, pixels.data(), pixels.size(), nullptr));
  msq_slicer_release(slicer);
  const msq_io::PngRows image{width, width, 1, 1};
  msq_measured([&] {
    rows.clear(), stream.clear();
    msq_io::copy_rows(image, pixels.data(), width / 8, rows);
    msq_io::encode_png(image, rows, level, stream);
  });
}
#endif

/// A model of a context of one thread, for one kernel.
template <class Make, class Work>
std::function<void()> with(Make make, Work work) {
  return [=] {
    msq_context* const context = bench::make_context(1);
    msq_model* const model = make(context);
    work(model);
    msq_model_release(model);
    msq_context_release(context);
  };
}

struct Kernel {
  const char* name;
  std::function<void()> run;
};

std::vector<Kernel> kernels() {
  const auto foam = [](int cells, int32_t method = MSQ_FOAM_AUTO) {
    return [=](msq_context* c) { return bench::make_foam_model(c, cells, method); };
  };
  const auto lattice = [](int cells, bool is_turned) {
    return [=](msq_context* c) { return make_lattice(c, cells, is_turned); };
  };
  const auto warped = [](int32_t kind) {
    return [=](msq_context* c) { return make_warped_gyroid(c, kind); };
  };
  const auto gyroid = [](int cells, bool is_turned) {
    return [=](msq_context* c) { return make_gyroid(c, cells, is_turned); };
  };
  const auto slices = [](uint64_t layers) {
    return [=](msq_model* model) { slice(model, layers); };
  };
  const auto set = [](size_t count) { return [=](msq_model* m) { ask_membership(m, count); }; };
  const auto far = [](size_t count) { return [=](msq_model* m) { ask_distances(m, count); }; };
  const auto single = [](size_t count) { return [=](msq_model* m) { ask_points(m, count); }; };
  const auto picture = [](uint32_t size) { return [=](msq_model* m) { render(m, size); }; };
  return {
    {"foam: edges of bricks", build_edges}, {"foam: rows", with(foam(16), slices(32))},
        {"foam: rows, radius by an expression",
         with([](msq_context* c) { return make_waving_foam(c, 16); }, slices(32))},
        {"foam: points, one by one", with(foam(16, MSQ_FOAM_POINT), single(5000))},
        {"foam: points as a set", with(foam(8), set(20000))},
        {"foam: distances", with(foam(8), far(1000))}, {"foam: rays", with(foam(8), picture(96))},
        {"foam: contours", with(foam(16), outline)}, {"walls: faces of bricks", build_faces},
        {"walls: rows", with([](msq_context* c) { return make_walls(c, 16); }, slices(32))},
        {"beams: rows", with(make_beams, slices(32))},
        {"waves: rows", with(make_waves, slices(32))},
        {"lattice: rows along the grid", with(lattice(9, false), slices(64))},
        {"lattice: rows of a turned grid", with(lattice(9, true), slices(16))},
        {"lattice: rows, radius by a gradient",
         with([](msq_context* c) { return make_lattice(c, 4, false, true); }, slices(64))},
        {"lattice: rays", with(lattice(9, false), picture(96))},
        {"lattice: contours", with(lattice(9, false), outline)},
        {"functional: rows along the grid", with(gyroid(9, false), slices(64))},
        {"functional: rows of a turned grid", with(gyroid(9, true), slices(16))},
        {"functional: rows by a map of samples", with(warped(MSQ_WARP_SAMPLED), slices(32))},
        {"functional: rows of twisted cells", with(warped(MSQ_WARP_CYLINDRICAL), slices(32))},
        {"functional: rays", with(gyroid(9, false), picture(48))},
        {"functional: contours", with(gyroid(9, false), outline)},
        {"mesh: reading the arrays", read_part}, {"mesh: rows", with(make_part, slices(64))},
        {"mesh: distances", with(make_part, far(2000))},
        {"mesh: rays", with(make_part, picture(128))},
#if MSQ_WITH_PNG
        {"PNG: bits, ISA-L", with(foam(16), [](msq_model* m) { encode(m, 0); })},
        {"PNG: bits, libpng", with(foam(16), [](msq_model* m) { encode(m, 1); })},
#endif
  };
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) throw std::runtime_error("usage: instructions KERNEL | --list");
  const bool is_list = std::strcmp(arguments[1], "--list") == 0;
  if (!is_list && !(hwy::SupportedTargets() & HWY_AVX2))
    throw std::runtime_error("this processor has no AVX2");
  hwy::SetSupportedTargetsForTest(HWY_AVX2);
  bool is_known = is_list;
  for (const Kernel& kernel : kernels()) {
    if (is_list) std::printf("%s\n", kernel.name);
    if (is_list || std::strcmp(kernel.name, arguments[1]) != 0) continue;
    is_known = true;
    kernel.run();
  }
  if (!is_known) throw std::runtime_error("no kernel of this name; --list lists them");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
