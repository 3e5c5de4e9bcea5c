// SPDX-License-Identifier: Apache-2.0
// Pictures by rays, two threads, parallel rays: Voronoi foams (r = 0.1 cell) in the unit cube,
// first and next frame, against Embree and against the paper's march; other structures for the
// record.
//
// usage: rays [results.json] [most cells along a side: 32, 128, 256 or 4096 (default)]
//        [most cells that Embree gets, default 32]
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "base/ray.h"
#include "bench.h"
#include "foam_rays.h"

#if MSQ_WITH_EMBREE
#include "embree_foam.h"
#endif

namespace {

using bench::check;

constexpr std::array<double, 3> front{0, 1, 0}, corner{-1, -1, -1};

/// Runs of the same work.
class Costs {
 public:
  void measure(const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    seconds_.push_back(bench::seconds_of(work));
    processor_.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  size_t runs() const { return seconds_.size(); }
  /// Medians: of the time that passed, and of half the processor time, which on two free cores is
  /// the same and on busy ones says more.
  double seconds() const { return median(seconds_); }
  double processor() const { return median(processor_) / 2; }
  void add_to(bench::Report& report, const std::string& work, double units,
              const std::string& unit) const {
    report.add(work, seconds(), units, unit);
    report.note("  half the processor time", processor(), "s");
  }

 private:
  static double median(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    return times[times.size() / 2];
  }
  std::vector<double> seconds_, processor_;
};

/// At least three runs, of up to about 3 seconds together; one where one takes more.
Costs costs_of(const std::function<void()>& work) {
  Costs costs;
  do costs.measure(work);
  while (costs.seconds() < 3 &&
         (costs.runs() < 3 || (costs.seconds() * costs.runs() < 3 && costs.runs() < 15)));
  return costs;
}

/// Most memory of the process since it was last asked to forget; Linux alone.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}
double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      double kilobytes;
      status >> kilobytes;
      return kilobytes / 1e3;
    }
  return 0;
}

/// To reach, seconds and megabytes; 0: no mark is set.
struct Marks {
  double first, next, megabytes;
};

/// Frames of a new context, from nothing to the picture, and the same again.
void bench_foam(bench::Report& report, const std::string& name, int cells, uint32_t side,
                std::array<double, 3> direction, Marks marks) {
  Costs first, next;
  bench::Picture picture(side);  // a host reuses its own
  msq_cache_report cache{};
  double held = 0, peak = 0, hit = 0;
  do {
    forget_peak();
    msq_context* context = nullptr;
    msq_model* model = nullptr;
    msq_camera camera;
    first.measure([&] {
      context = bench::make_context();
      model = bench::make_foam_model(context, cells);
      camera = bench::fit_camera(model, direction, side);
      picture.render(model, camera);
    });
    for (int i = 0; i < 2; ++i) next.measure([&] { picture.render(model, camera); });
    cache = bench::cache_of(context);
    msq_memory_report memory{};
    memory.struct_size = sizeof memory;
    check(msq_context_memory(context, &memory));
    held = static_cast<double>(memory.peak_bytes) / 1e6;
    peak = peak_megabytes();
    msq_model_release(model);
    msq_context_release(context);
  } while (first.runs() < 7 && first.seconds() < 1.5);
  for (const float depth : picture.depth) hit += std::isfinite(depth);
  first.add_to(report, name + ", first frame", picture.rays(), "ray");
  if (marks.first > 0) report.mark("  first frame", first.seconds(), "s", marks.first, false);
  next.add_to(report, name + ", next frame", picture.rays(), "ray");
  if (marks.next > 0) report.mark("  next frame", next.seconds(), "s", marks.next, false);
  report.note("  hit", 100 * hit / picture.rays(), "% of rays");
  report.note("  memory of the context, at most", held, "MB");
  if (marks.megabytes > 0)
    report.mark("  memory of the process, at most", peak, "MB", marks.megabytes, false);
  else
    report.note("  memory of the process, at most", peak, "MB");
  report.note("  cache: built", static_cast<double>(cache.misses), "");
  report.note("  cache: found", static_cast<double>(cache.hits), "");
  report.note("  cache: built twice", static_cast<double>(cache.duplicates), "");
}

/// The rays of a camera's picture, in model units.
struct Rays {
  Rays(const msq_camera& camera, uint32_t side) {
    for (uint32_t j = 0; j < side; ++j)
      for (uint32_t i = 0; i < side; ++i) {
        const double position[2] = {i + 0.5, j + 0.5};
        double origin[3], direction[3];
        check(msq_camera_ray(&camera, side, side, position, origin, direction));
        all.push_back(
            {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}});
      }
  }
  std::vector<msq::Ray> all;
};

/// The part of a ray in the unit cube.
bool clip(const msq::Ray& ray, double& from, double& to) {
  from = 0;
  to = std::numeric_limits<double>::infinity();
  return msq::clip_to_box(ray, {{0, 0, 0}, {1, 1, 1}}, from, to);
}

#if MSQ_WITH_EMBREE
void bench_embree(bench::Report& report, int cells, uint32_t side) {
  msq_context* context = bench::make_context();
  msq_model* model = bench::make_foam_model(context, cells);
  const msq_camera camera = bench::fit_camera(model, front, side);
  bench::Picture picture(side);
  picture.render(model, camera);
  const Costs ours = costs_of([&] { picture.render(model, camera); });
  msq_model_release(model);
  msq_context_release(context);

  const Rays pixels(camera, side);
  std::vector<bench::EmbreeRay> rays;
  for (const msq::Ray& pixel : pixels.all) {
    bench::EmbreeRay ray{};
    double from, to;
    const bool is_there = clip(pixel, from, to);
    ray.from = static_cast<float>(from * cells);
    ray.to = static_cast<float>(is_there ? to * cells : -1);
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = static_cast<float>(pixel.origin[axis] * cells);
      ray.direction[axis] = static_cast<float>(pixel.direction[axis]);
    }
    rays.push_back(ray);
  }
  const std::string name =
      std::to_string(side) + "^2, " + std::to_string(cells) + "^3 cells, front, ";
  forget_peak();
  bench::EmbreeFoam foam(cells);
  costs_of([&] { foam.build(); })
      .add_to(report, "Embree: " + name + "build, edges not counted",
              static_cast<double>(foam.edges()), "edge");
  report.note("  memory of the process, at most", peak_megabytes(), "MB");
  std::vector<float> t;
  double best = std::numeric_limits<double>::infinity();
  for (const bool by_packets : {false, true}) {
    const Costs costs = costs_of([&] { foam.cast(rays, by_packets, t); });
    costs.add_to(report, "Embree: " + name + (by_packets ? "packets of 16" : "single rays"),
                 picture.rays(), "ray");
    best = std::min(best, costs.processor());
  }
  ours.add_to(report, "msq: " + name + "next frame", picture.rays(), "ray");
  report.note("  Embree's best against that, processor time", best / ours.processor(),
              "times as long");
  // Where a ray enters the cube inside a strut, Embree sees the strut's far side or the next one.
  double same = 0, compared = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (picture.depth[i] * cells < rays[i].from + 1e-3f) continue;
    ++compared;
    same += std::isfinite(t[i]) == std::isfinite(picture.depth[i]) &&
            (!std::isfinite(t[i]) || std::abs(picture.depth[i] * cells - t[i]) < 2e-3f);
  }
  report.note("  the same depth within 0.002 cell", 100 * same / compared,
              "% of rays from outside");
}
#endif

/// The paper's march: rays in steps of a fixed length, a cell's length at a time; the samples of
/// all rays that are left go as one set, which msq groups by cell.
void bench_march(bench::Report& report, int32_t method, const std::string& method_name) {
  constexpr int cells = 32, steps = 20;  // a step is 0.05 cell, half the radius
  constexpr uint32_t side = 128;
  msq_context* context = bench::make_context();
  msq_model* model = bench::make_foam_model(context, cells, method);
  msq_model* direct = bench::make_foam_model(context, cells);
  const msq_camera camera = bench::fit_camera(model, front, side);
  bench::Picture picture(side);
  picture.render(direct, camera);
  const Costs ours = costs_of([&] { picture.render(direct, camera); });
  const Rays rays(camera, side);
  std::vector<double> depth;
  const auto march = [&] {
    depth.assign(rays.all.size(), std::numeric_limits<double>::infinity());
    std::vector<uint32_t> live;
    std::vector<double> at(rays.all.size()), to(rays.all.size());
    for (uint32_t i = 0; i < rays.all.size(); ++i)
      if (clip(rays.all[i], at[i], to[i])) live.push_back(i);
    const double step = 1.0 / cells / steps;
    std::vector<msq::Vec3> points;
    std::vector<uint8_t> inside;
    while (!live.empty()) {
      points.clear();
      for (const uint32_t i : live)
        for (int n = 0; n < steps; ++n) points.push_back(rays.all[i].at(at[i] + n * step));
      inside.resize(points.size());
      msq_points_def def;
      check(msq_points_def_init(&def, sizeof def));
      def.coordinates = points.data();
      def.count = points.size();
      check(msq_set_membership(model, &def, nullptr, inside.data(), inside.size(), nullptr));
      size_t left = 0;
      for (size_t k = 0; k < live.size(); ++k) {
        const uint32_t i = live[k];
        for (int n = 0; n < steps && std::isinf(depth[i]); ++n)
          if (inside[k * steps + static_cast<size_t>(n)]) depth[i] = at[i] + n * step;
        at[i] += steps * step;
        if (std::isinf(depth[i]) && at[i] <= to[i]) live[left++] = i;
      }
      live.resize(left);
    }
  };
  Costs first;
  first.measure(march);
  const Costs next = first.seconds() > 20 ? first : costs_of(march);
  const std::string name = "march, " + method_name + ", 128^2, 32^3 cells, front";
  first.add_to(report, name + ", first frame", picture.rays(), "ray");
  next.add_to(report, name + ", next frame", picture.rays(), "ray");
  ours.add_to(report, "msq_render, 128^2, 32^3 cells, front, next frame", picture.rays(), "ray");
  report.note("  march against that, processor time", next.processor() / ours.processor(),
              "times as long");
  double late = 0;
  for (size_t i = 0; i < depth.size(); ++i)
    late += depth[i] > picture.depth[i] + 1.01 / cells / steps;
  report.note("  rays that stepped over a surface", 100 * late / picture.rays(), "%");
  msq_model_release(direct);
  msq_model_release(model);
  msq_context_release(context);
}

msq_structure* make_lattice(msq_context* context, int32_t unit_cell, int cells) {
  msq_lattice_def def;
  check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &def, &lattice));
  return lattice;
}

msq_structure* make_gyroid(msq_context* context, int cells) {
  msq_functional_def def;
  check(msq_functional_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  msq_structure* gyroid;
  check(msq_structure_functional(context, &def, &gyroid));
  return gyroid;
}

/// A view of the unit cube, slanting, of structures within each other, the coarsest first.
void bench_structure(bench::Report& report, const std::string& name,
                     msq_structure* (*coarse)(msq_context*), msq_structure* (*fine)(msq_context*)) {
  constexpr uint32_t side = 512;
  msq_context* context = bench::make_context();
  msq_model* model = bench::make_model(context, bench::make_cube(context), coarse(context),
                                       {0, nullptr}, fine ? fine(context) : nullptr);
  const msq_camera camera = bench::fit_camera(model, {-0.3, 1, -0.2}, side);
  bench::Picture picture(side);
  Costs first;
  first.measure([&] { picture.render(model, camera); });
  first.add_to(report, "512^2, " + name + ", first frame", picture.rays(), "ray");
  costs_of([&] {
    picture.render(model, camera);
  }).add_to(report, "512^2, " + name + ", next frame", picture.rays(), "ray");
  msq_model_release(model);
  msq_context_release(context);
}

/// 16^3 cells; radius (in cells) and density by expressions, where not null, r = 0.1 otherwise.
msq_structure* make_field_foam(msq_context* context, const char* radius, const char* density) {
  constexpr int cells = 16;
  const auto make_field = [&](const char* expression, double low, double high) {
    msq_expression_field_def def;
    check(msq_expression_field_def_init(&def, sizeof def));
    def.expression = expression;
    def.low = low;
    def.high = high;
    msq_field* field;
    check(msq_field_expression(context, &def, &field));
    return field;
  };
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_field* const radii = radius ? make_field(radius, 0.05 / cells, 0.15 / cells) : nullptr;
  msq_field* const seeds = density ? make_field(density, 1, 8) : nullptr;
  def.radius.field = radii;
  def.density.field = seeds;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  msq_field_release(radii);
  msq_field_release(seeds);
  return foam;
}

/// The same with a linear radius, from 0.05 cell at one corner to 0.15 at the other.
msq_structure* make_tapered_foam(msq_context* context) {
  constexpr int cells = 16;
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  msq_field* radius;
  check(msq_field_gradient(context, low, 0.05 / cells, high, 0.15 / cells, &radius));
  def.radius.field = radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  msq_field_release(radius);
  return foam;
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Rays, two threads");
  const int largest = count > 2 ? std::atoi(arguments[2]) : 4096;
  [[maybe_unused]] const int embree = count > 3 ? std::atoi(arguments[3]) : 32;
  bench_foam(report, "1024^2, 32^3 cells, front", 32, 1024, front, {0.20, 0.14, 0});
  bench_foam(report, "1024^2, 32^3 cells, corner", 32, 1024, corner, {});
  if (largest >= 128)
    bench_foam(report, "2048^2, 128^3 cells, front", 128, 2048, front, {1.2, 0.6, 0});
  if (largest >= 256) {
    bench_foam(report, "2048^2, 256^3 cells, front", 256, 2048, front, {2.8, 0.7, 1000});
    bench_foam(report, "2048^2, 256^3 cells, corner", 256, 2048, corner, {4, 0.4, 1000});
  }
  if (largest >= 4096)
    bench_foam(report, "1024^2, 4096^3 cells, front", 4096, 1024, front, {60, 0, 0});
#if MSQ_WITH_EMBREE
  bench_embree(report, 32, 1024);
  if (embree >= 128) bench_embree(report, 128, 2048);
#endif
  bench_march(report, MSQ_FOAM_DIRECT, "sets by DIRECT");
  bench_march(report, MSQ_FOAM_METHOD_1, "METHOD_1");
  if (MSQ_WITH_CGAL) bench_march(report, MSQ_FOAM_METHOD_2, "METHOD_2");
  bench_structure(
      report, "BCC lattice, 16^3 cells",
      [](msq_context* c) { return make_lattice(c, MSQ_UNIT_CELL_BCC, 16); }, nullptr);
  bench_structure(
      report, "octet lattice, 16^3 cells",
      [](msq_context* c) { return make_lattice(c, MSQ_UNIT_CELL_OCTET, 16); }, nullptr);
  bench_structure(
      report, "gyroid, 16^3 cells", [](msq_context* c) { return make_gyroid(c, 16); }, nullptr);
  bench_structure(
      report, "gyroid of 128^3 cells in an octet lattice of 8^3",
      [](msq_context* c) { return make_lattice(c, MSQ_UNIT_CELL_OCTET, 8); },
      [](msq_context* c) { return make_gyroid(c, 128); });
  bench_structure(
      report, "foam, 16^3 cells",
      [](msq_context* c) { return make_field_foam(c, nullptr, nullptr); }, nullptr);
  bench_structure(report, "foam of linear radius, 16^3 cells", make_tapered_foam, nullptr);
  bench_structure(
      report, "foam of radius by expression, 16^3 cells",
      [](msq_context* c) {
        return make_field_foam(c, "(0.1 + 0.05 * sin(5 * x) * cos(4 * y + 3 * z)) / 16", nullptr);
      },
      nullptr);
  bench_structure(
      report, "foam of density 1 to 8, 16^3 cells",
      [](msq_context* c) { return make_field_foam(c, nullptr, "1 + 7 * x"); }, nullptr);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
