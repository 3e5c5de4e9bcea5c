// SPDX-License-Identifier: Apache-2.0
// Voronoi foams, r = 0.1 cell, in the unit cube: edges against CGAL and voro++, slices by each
// method.
//
// usage: foam [results.json] [largest slices, default 2048]
#include <hwy/highway.h>

#include <cstdlib>
#include <string>

#include "bench.h"
#include "structure/foam/edges.h"

#if MSQ_WITH_CGAL
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif
#if MSQ_WITH_VOROPP
#include <voro++/voro++.hh>
#endif

namespace {

constexpr int side = 32;  // cells of the edge benchmarks

std::vector<msq::Vec3> all_seeds(const msq::FoamSeeds& seeds) {
  std::vector<msq::Vec3> positions;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        positions.push_back(msq::Vec3{double(x), double(y), double(z)} +
                            seeds.at({x, y, z}, 0, 0, 0));
  return positions;
}

void bench_edges(bench::Report& report) {
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  const double count = side * side * side;
  size_t edges = 0;
  const double ours = bench::median_seconds([&] {
    edges = 0;
    for (int z = 0; z < side; z += msq::EdgeBrick::side)
      for (int y = 0; y < side; y += msq::EdgeBrick::side)
        for (int x = 0; x < side; x += msq::EdgeBrick::side)
          edges += msq::EdgeBrick(seeds, {x, y, z}).segments().count();
  });
  report.add("edges of 32^3 seeds, msq, one thread", ours, count, "seed");
  report.note("edges a seed", static_cast<double>(edges) / count, "");
  const std::vector<msq::Vec3> positions = all_seeds(seeds);
#if MSQ_WITH_CGAL
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const msq::Vec3& p : positions) points.emplace_back(p.x, p.y, p.z);
  double length = 0;
  const double cgal = bench::median_seconds([&] {
    const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
    length = 0;
    for (const auto& [cell, corner] : triangulation.finite_facets()) {
      const auto other = cell->neighbor(corner);
      if (triangulation.is_infinite(cell) || triangulation.is_infinite(other)) continue;
      length += (triangulation.dual(cell) - triangulation.dual(other)).squared_length();
    }
  });
  report.add("edges of 32^3 seeds, CGAL Delaunay of all at once", cgal, count, "seed");
  report.note("msq against CGAL", cgal / ours, "times faster");
#endif
#if MSQ_WITH_VOROPP
  size_t vertices = 0;
  const double voropp = bench::median_seconds([&] {
    voro::container box(0, side, 0, side, 0, side, side / 2, side / 2, side / 2, false, false,
                        false, 8);
    for (size_t i = 0; i < positions.size(); ++i)
      box.put(static_cast<int>(i), positions[i].x, positions[i].y, positions[i].z);
    voro::voronoicell cell;
    voro::c_loop_all loop(box);
    if (loop.start()) do {
        if (box.compute_cell(cell, loop)) vertices += static_cast<size_t>(cell.p);
      } while (loop.inc());
  });
  report.add("cells of 32^3 seeds, voro++", voropp, count, "seed");
  report.note("msq against voro++", voropp / ours, "times faster");
#endif
}

struct Foam {
  msq_context* context;
  msq_model* model;
};

/// r: 0.1 cell; or `graded`, from 0.05 cell at one corner of the cube to 0.15 at the other.
Foam make_foam(int cells, int32_t method, uint64_t cache_bytes, bool graded = false) {
  Foam foam{};
  msq_context_def context_def;
  bench::check(msq_context_def_init(&context_def, sizeof context_def));
  context_def.threads = 2;
  context_def.cache_bytes = cache_bytes;
  bench::check(msq_context_create(&context_def, &foam.context));
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  msq_shape* cube;
  bench::check(msq_shape_from_box(foam.context, low, high, &cube));
  msq_foam_def def;
  bench::check(msq_foam_def_init(&def, sizeof def));
  def.method = method;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_field* field = nullptr;
  if (graded) {
    bench::check(msq_field_gradient(foam.context, low, 0.05 / cells, high, 0.15 / cells, &field));
    def.radius = {0, field};
  }
  msq_structure* structure;
  bench::check(msq_structure_foam(foam.context, &def, &structure));
  msq_field_release(field);
  const msq_scale_def scales[] = {{cube, nullptr}, {nullptr, structure}};
  msq_model_def model_def;
  bench::check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  bench::check(msq_model_create(foam.context, &model_def, &foam.model));
  msq_structure_release(structure);
  msq_shape_release(cube);
  return foam;
}

/// Seconds for the first `layers` layers, from an empty cache; and the bytes held at most.
double slice_seconds(int cells, uint32_t resolution, uint64_t layers, int32_t method,
                     uint64_t cache_bytes, double& peak, bool graded = false) {
  const Foam foam = make_foam(cells, method, cache_bytes, graded);
  msq_slicer_def def;
  bench::check(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = resolution;
  def.layer_height = 1.0 / resolution;
  msq_slicer* slicer;
  bench::check(msq_slicer_create(foam.model, &def, &slicer));
  bench::Reader reader;
  const double seconds = bench::median_seconds([&] {
    bench::check(msq_cache_clear(foam.context));
    bench::check(msq_slicer_run(slicer, 0, layers, bench::Reader::take, &reader, nullptr));
  });
  msq_memory_report memory{};
  memory.struct_size = sizeof memory;
  bench::check(msq_context_memory(foam.context, &memory));
  peak = static_cast<double>(memory.peak_bytes);
  msq_slicer_release(slicer);
  msq_model_release(foam.model);
  msq_context_release(foam.context);
  return seconds;
}

constexpr uint64_t cache = uint64_t{128} << 20;

void bench_slices(bench::Report& report, uint32_t largest) {
  for (uint32_t resolution = 512; resolution <= largest; resolution *= 2)
    for (int cells : {32, 128, 256}) {
      double peak;
      const double seconds =
          slice_seconds(cells, resolution, UINT64_MAX, MSQ_FOAM_DIRECT, cache, peak);
      const double samples = static_cast<double>(resolution) * resolution * resolution;
      const std::string name =
          std::to_string(resolution) + "^3, " + std::to_string(cells) + "^3 cells";
      report.add("DIRECT, " + name, seconds, samples, "sample");
      report.note("  peak memory", peak / 1e6, "MB");
    }
}

/// What a gradient of r, and AVX2 in place of wider vectors, cost.
void bench_variants(bench::Report& report, uint32_t resolution) {
  const double samples = static_cast<double>(resolution) * resolution * resolution;
  double peak;
  for (int cells : {32, 256}) {
    const std::string name =
        std::to_string(resolution) + "^3, " + std::to_string(cells) + "^3 cells";
    const auto seconds = [&](bool graded) {
      return slice_seconds(cells, resolution, UINT64_MAX, MSQ_FOAM_DIRECT, cache, peak, graded);
    };
    const double constant = seconds(false), graded = seconds(true);
    report.add("DIRECT, " + name + ", gradient of r", graded, samples, "sample");
    report.note("  against constant r", graded / constant, "times the time");
    if (!(hwy::SupportedTargets() & HWY_AVX2)) continue;
    hwy::SetSupportedTargetsForTest(HWY_AVX2);
    const double avx2 = seconds(false);
    hwy::SetSupportedTargetsForTest(0);
    report.add("DIRECT, " + name + ", AVX2", avx2, samples, "sample");
    report.note("  against all instruction sets", avx2 / constant, "times the time");
  }
}

/// The other methods on the same few layers of 512^3, 32^3 cells.
void bench_methods(bench::Report& report) {
  constexpr uint64_t layers = 32;
  constexpr double samples = 512.0 * 512.0 * layers;
  double peak;
  const double direct = slice_seconds(32, 512, layers, MSQ_FOAM_DIRECT, 1 << 30, peak);
  report.add("DIRECT, 32 layers of 512^3, 32^3 cells", direct, samples, "sample");
  const double point = slice_seconds(32, 512, layers, MSQ_FOAM_POINT, 1 << 30, peak);
  report.add("POINT, the same", point, samples, "sample");
  report.note("DIRECT against POINT", point / direct, "times faster");
#if MSQ_WITH_CGAL
  const double method_2 = slice_seconds(32, 512, layers, MSQ_FOAM_METHOD_2, 1 << 30, peak);
  report.add("METHOD_2, the same", method_2, samples, "sample");
  report.note("DIRECT against METHOD_2", method_2 / direct, "times faster");
#endif
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Voronoi foams, r = 0.1 cell");
  bench_edges(report);
  bench_methods(report);
  const uint32_t largest = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  bench_slices(report, largest);
  bench_variants(report, largest);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
