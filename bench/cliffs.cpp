// SPDX-License-Identifier: Apache-2.0
// Looks for cliffs: cases that take many times as long as a plain case of the same work. Sweeps one
// property at a time and prints its ratio to the plain case of the same sweep, in processor time.
//
// The plain cases: a structure of 32^3 cubic cells in the unit cube, r = 0.1 cell, two threads. In
// a sweep of cell sizes the number of cells stays the same, and r is 0.1 of the smallest side. In a
// sweep of cells per side the plain time grows with the number of samples or of cells, whichever
// grows more.
//
// usage: cliffs [results.json] [part of the names of the sweeps to measure]
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>

#include "cliff_report.h"
#include "rippled_torus.h"
#include "setup.h"

namespace {

constexpr double max_ratio = 2;
constexpr uint64_t plain_cache = uint64_t{1} << 30;

enum class Kind { struts, walls, lattice, gyroid };
enum class Work { slices, layer, points, distances, rays };

struct Setting {
  Kind kind = Kind::struts;
  Work work = Work::slices;
  double cells = 32;
  std::array<double, 3> aspect{1, 1, 1};  ///< of the sides of cells
  std::array<double, 2> turn{0, 0};       ///< about z, then about x
  double jitter = 1, density = 1;
  double radius = 0.1;  ///< of struts, or whole thickness of walls: in the smallest side
  uint64_t cache = plain_cache;
  uint32_t resolution = 320, slab = 0;
};

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

void place(msq_neighbourhood& grid, const Setting& setting, double& smallest) {
  const auto& a = setting.aspect;
  const double unit = 1 / (setting.cells * std::cbrt(a[0] * a[1] * a[2]));
  smallest = 1e300;
  for (size_t axis = 0; axis < 3; ++axis) {
    grid.cell_size[axis] = a[axis] * unit;
    smallest = std::min(smallest, grid.cell_size[axis]);
  }
  const double c = std::cos(setting.turn[0]), s = std::sin(setting.turn[0]);
  const double d = std::cos(setting.turn[1]), t = std::sin(setting.turn[1]);
  const double rotation[9] = {c, -s * d, s * t, s, c * d, -c * t, 0, t, d};
  for (size_t i = 0; i < 9; ++i) grid.rotation[i] = rotation[i];
}

msq_structure* make_structure(msq_context* context, const Setting& setting) {
  msq_structure* structure;
  double smallest;
  if (setting.kind == Kind::lattice) {
    msq_lattice_def def;
    bench::check(msq_lattice_def_init(&def, sizeof def));
    place(def.grid, setting, smallest);
    def.radius.value = setting.radius * smallest;
    bench::check(msq_structure_lattice(context, &def, &structure));
  } else if (setting.kind == Kind::gyroid) {
    msq_functional_def def;
    bench::check(msq_functional_def_init(&def, sizeof def));
    place(def.grid, setting, smallest);
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.thickness.value = setting.radius * smallest;
    bench::check(msq_structure_functional(context, &def, &structure));
  } else {
    msq_foam_def def;
    bench::check(msq_foam_def_init(&def, sizeof def));
    place(def.grid, setting, smallest);
    (setting.kind == Kind::walls ? def.wall_thickness : def.radius).value =
        setting.radius * smallest;
    def.jitter = setting.jitter;
    def.density.value = setting.density;
    bench::check(msq_structure_foam(context, &def, &structure));
  }
  return structure;
}

double slice_seconds(msq_context* context, const msq_model* model, const Setting& setting) {
  msq_slicer_def def = bench::slices_of(setting.resolution);
  def.slab_layers = setting.slab;
  msq_slicer* slicer = bench::make_slicer(model, def);
  std::vector<uint8_t> layer(size_t{setting.resolution} * (setting.resolution / 8 + 8));
  bench::Reader reader;
  const double seconds = bench::min_processor_seconds([&] {
    bench::check(msq_cache_clear(context));
    if (setting.work == Work::layer)
      bench::check(
          msq_slice_layer(slicer, setting.resolution / 2, layer.data(), layer.size(), nullptr));
    else
      bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  msq_slicer_release(slicer);
  return seconds;
}

double point_seconds(const msq_model* model, const Setting& setting) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const size_t count = setting.work == Work::points ? 400000 : 20000;
  std::vector<double> coordinates(3 * count), distance(count);
  for (double& c : coordinates) c = uniform(random);
  std::vector<uint8_t> inside(count);
  msq_points_def points;
  bench::check(msq_points_def_init(&points, sizeof points));
  points.coordinates = coordinates.data();
  points.count = count;
  return bench::min_processor_seconds([&] {
    if (setting.work == Work::points)
      bench::check(
          msq_set_membership(model, &points, nullptr, inside.data(), inside.size(), nullptr));
    else
      bench::check(
          msq_set_distance(model, &points, nullptr, distance.data(), distance.size(), nullptr));
  });
}

/// Depth of 320 x 320 parallel rays, from an empty cache.
double ray_seconds(msq_context* context, const msq_model* model) {
  const double direction[3] = {0.3, 0.2, -1};
  constexpr uint32_t side = 320;
  msq_camera camera;
  bench::check(msq_camera_init(&camera, sizeof camera));
  bench::check(msq_camera_fit(model, direction, nullptr, side, side, &camera));
  std::vector<float> depth(size_t{side} * side);
  msq_render_def def;
  bench::check(msq_render_def_init(&def, sizeof def));
  def.width = def.height = side;
  msq_frame frame;
  bench::check(msq_frame_init(&frame, sizeof frame));
  frame.depth = depth.data();
  return bench::min_processor_seconds([&] {
    bench::check(msq_cache_clear(context));
    bench::check(msq_render(model, &camera, &def, nullptr, &frame, nullptr, nullptr, nullptr));
  });
}

double seconds_of(const Setting& setting) {
  msq_context* context = bench::make_context(2, setting.cache);
  msq_model* model =
      bench::make_model(context, bench::make_cube(context), make_structure(context, setting));
  double seconds = 0;
  if (setting.work == Work::rays)
    seconds = ray_seconds(context, model);
  else if (setting.work == Work::slices || setting.work == Work::layer)
    seconds = slice_seconds(context, model, setting);
  else
    seconds = point_seconds(model, setting);
  msq_model_release(model);
  msq_context_release(context);
  return seconds;
}

std::string name_of(const Setting& setting) {
  const char* const kinds[] = {"foam", "walls", "lattice", "gyroid"};
  const char* const works[] = {"slices", "one layer", "points", "distances", "rays"};
  return std::string(kinds[static_cast<int>(setting.kind)]) + " of " + text(setting.cells) +
         "^3, " + works[static_cast<int>(setting.work)];
}

class Sweeps {
 public:
  explicit Sweeps(bench::CliffReport& report) : report_(report) {}

  /// Cases that differ from the plain one in one property.
  void run(const Setting& plain) {
    plain_ = plain;
    const bool is_foam = plain.kind == Kind::struts,
               is_sliced = plain.work == Work::slices || plain.work == Work::layer;
    const bool is_walls = plain.kind == Kind::walls;
    begin("aspect", [&] {
      std::vector<std::array<double, 3>> aspects{{1, 1, 1.25}, {1, 1, 1.5}, {1, 1, 2}, {1, 1, 4},
                                                 {1, 2, 2},    {4, 1, 1},   {1, 4, 4}, {1, 2, 4}};
      if (!is_foam && !is_walls)
        aspects.insert(aspects.end(),
                       {{1, 1, 100}, {1, 1, 1e4}, {100, 1, 1}, {1, 100, 100}, {1, 1e4, 1e4}});
      for (const auto& a : aspects) {
        Setting s = plain;
        s.aspect = a;
        add(text(a[0]) + " : " + text(a[1]) + " : " + text(a[2]), s);
      }
    });
    begin("turn", [&] {
      const std::array<std::array<double, 2>, 4> turns{
          {{1e-3, 0}, {0.7, 0}, {0.785398, 0.615480}, {0.7, 0.4}}};
      for (const auto& t : turns) {
        Setting s = plain;
        s.turn = t;
        add("about z " + text(t[0]) + ", x " + text(t[1]), s);
      }
    });
    if (is_foam || is_walls)
      begin("jitter", [&] {
        for (double jitter : {0.0, 1e-9, 1e-4, 0.02, 0.2, 0.5}) {
          Setting s = plain;
          s.jitter = jitter;
          add(text(jitter), s);
        }
      });
    if (is_foam)
      begin("density, as many seeds", [&] {
        for (double density : {1.1, 2.0, 8.0, 64.0}) {
          Setting s = plain;
          s.density = density;
          s.cells = plain.cells / std::cbrt(density);
          add(text(density), s);
        }
      });
    begin(is_foam || plain.kind == Kind::lattice ? "radius" : "thickness", [&] {
      std::vector<double> radii{0.01, 0.03, 0.05, 0.2, 0.26, 0.3};
      // Sheets of a gyroid fill the cell soon after.
      if (plain.kind != Kind::gyroid) radii.insert(radii.end(), {0.5, 0.7, 0.9});
      for (double radius : radii) {
        Setting s = plain;
        s.radius = radius;
        add(text(radius), s);
      }
    });
    if (is_foam || is_walls)
      begin("cache in bytes", [&] {
        for (double bytes : {0.0, 1e4, 1e6, 4e6, 16e6, 64e6}) {
          Setting s = plain;
          s.cache = static_cast<uint64_t>(bytes);
          add(text(bytes), s);
        }
      });
    if (plain.work == Work::slices)
      begin("layers of a slab", [&] {
        for (uint32_t slab : {1u, 2u, 4u, 8u, 16u, 32u}) {
          Setting s = plain;
          s.slab = slab;
          add(text(slab), s);
        }
      });
    if (is_sliced) {
      begin("cells along a side", [&] { add_pitches(plain); });
      Setting turned = plain;
      turned.turn = {0.7, 0.4};
      begin("cells along a side, turned", [&] { add_pitches(turned); });
    }
  }

 private:
  template <class Cases>
  void begin(const std::string& property, Cases&& cases) {
    sweep_ = name_of(plain_) + ": " + property;
    if (!report_.wants(sweep_)) return;
    seconds_ = seconds_of(plain_);
    report_.add(sweep_, "plain", seconds_, seconds_);
    cases();
  }
  void add(const std::string& name, const Setting& setting, double growth = 1) {
    report_.add(sweep_, name, seconds_of(setting), growth * seconds_);
  }

  void add_pitches(const Setting& setting) {
    for (double cells : {2.0, 4.0, 8.0, 16.0, 48.0, 64.0, 96.0, 128.0, 192.0, 256.0, 320.0}) {
      Setting s = setting;
      s.cells = cells;
      const double by_layer = setting.work == Work::layer ? 2 : 3;
      add(text(cells), s, std::max(1.0, std::pow(cells / plain_.cells, by_layer)));
    }
  }

  bench::CliffReport& report_;
  Setting plain_;
  std::string sweep_;
  double seconds_ = 0;
};

/// How long a host waits for the first layer of a run of 2048^3 samples in a foam, and for one
/// layer in the middle, from an empty cache.
void note_waits(bench::CliffReport& report) {
  const std::string what = "waiting for the first layer of 2048^3, foam of ";
  if (!report.wants(what)) return;
  for (double cells : {32.0, 128.0, 256.0}) {
    Setting setting;
    setting.cells = cells;
    setting.resolution = 2048;
    msq_context* context = bench::make_context(2, setting.cache);
    msq_model* model =
        bench::make_model(context, bench::make_cube(context), make_structure(context, setting));
    msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(setting.resolution));
    double first = 0;
    const double start = bench::processor_seconds();
    msq_slicer_run(
        slicer, 0, UINT64_MAX,
        [](void* user, const msq_layer*) -> int32_t {
          *static_cast<double*>(user) = bench::processor_seconds();
          return 1;
        },
        &first, nullptr);
    report.note(what + text(cells) + "^3", first - start);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
    setting.work = Work::layer;
    report.note("one layer of 2048^2, foam of " + text(cells) + "^3", seconds_of(setting));
  }
}

/// Slices with a skin about empty space, under a mesh of 270,400 triangles, against a skin of 1 mm
/// of a part of 100 mm.
void sweep_skins(bench::CliffReport& report) {
  const std::string sweep = "skin of a mesh, part of 100 mm: thickness in mm";
  if (!report.wants(sweep)) return;
  msq_context* context = bench::make_context();
  msq_shape* shape = bench::make_shape(context, bench::rippled_torus(520, 260));
  const auto seconds = [&](double thickness) {
    Setting setting;
    setting.kind = Kind::lattice;
    setting.cells = 4;
    setting.radius = 0.008;
    msq_shape_retain(shape);
    msq_model* model =
        bench::make_model(context, shape, make_structure(context, setting), {thickness, nullptr});
    const double middle[3] = {0.5, 0.5, 0.5};  // builds the tree of the mesh
    double distance;
    bench::check(msq_point_distance(model, middle, nullptr, &distance));
    msq_slicer_def def;
    bench::check(msq_slicer_def_init(&def, sizeof def));
    def.resolution[0] = def.resolution[1] = setting.resolution;
    def.layer_count = setting.resolution;
    def.layer_height = 1.0 / setting.resolution;
    def.has_region = 1;
    for (double& v : def.region_max) v = 1;
    msq_slicer* slicer;
    bench::check(msq_slicer_create(model, &def, &slicer));
    msq_model_release(model);
    bench::Reader reader;
    const double least = bench::min_processor_seconds([&] {
      bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
    });
    msq_slicer_release(slicer);
    return least;
  };
  const double plain = seconds(0.01);
  report.add(sweep, "1, plain", plain, plain);
  for (double mm : {0.05, 0.1, 0.2, 0.5, 2.0, 5.0})
    report.add(sweep, text(mm), seconds(0.01 * mm), plain);
  msq_shape_release(shape);
  msq_context_release(context);
}

}  // namespace

int main(int count, char** arguments) try {
  bench::CliffReport report(max_ratio, count > 2 ? arguments[2] : "");
  Sweeps sweeps(report);
  for (Kind kind : {Kind::struts, Kind::walls, Kind::lattice, Kind::gyroid})
    for (Work work : {Work::slices, Work::layer, Work::points, Work::distances, Work::rays}) {
      Setting plain;
      plain.kind = kind;
      plain.work = work;
      // Otherwise walls without jitter end exactly on samples, which the definition then decides.
      if (kind == Kind::walls) plain.radius = 0.13;
      sweeps.run(plain);
    }
  Setting fine;
  fine.cells = 96;
  sweeps.run(fine);
  sweep_skins(report);
  note_waits(report);
  report.finish(count > 1 ? arguments[1] : nullptr);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
