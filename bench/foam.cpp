// SPDX-License-Identifier: Apache-2.0
// Voronoi foams, r = 0.1 cell, in the unit cube: edges against CGAL and voro++, and slices.
//
// usage: foam [results.json] [largest slices, default 2048]
#include <hwy/highway.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "foam_setup.h"
#include "structure/foam/edges/edge_brick.h"

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

template <class Visit>
void for_each_brick(Visit&& visit) {
  for (int z = 0; z < side; z += msq::EdgeBrick::side)
    for (int y = 0; y < side; y += msq::EdgeBrick::side)
      for (int x = 0; x < side; x += msq::EdgeBrick::side) visit(msq::CellIndex{x, y, z});
}

/// Bricks of seeds in cells of several shapes and jitters, by the quicker walk that can find them.
void bench_grids(bench::Report& report) {
  struct Grid {
    const char* name;
    double jitter;
    msq::Vec3 scale;
  };
  for (const Grid& grid :
       {Grid{"cubes, jitter 0.1", 0.1, {1, 1, 1}}, Grid{"cells 1 x 1 x 3/4", 1, {1, 1, 0.75}},
        Grid{"cells 1 x 1 x 1/2", 1, {1, 1, 0.5}}, Grid{"cells 1 x 1 x 1/4", 1, {1, 1, 0.25}},
        Grid{"cells 1 x 1/3 x 1/9", 1, {1, 1.0 / 3, 1.0 / 9}},
        Grid{"cubes, jitter 0", 0, {1, 1, 1}}}) {
    const msq::FoamSeeds seeds(0, grid.jitter, grid.scale);
    const double seconds = bench::median_seconds(
        [&] { for_each_brick([&](msq::CellIndex at) { msq::EdgeBrick(seeds, at); }); }, 1);
    report.add(std::string("edges of 32^3 seeds, ") + grid.name, seconds, side * side * side,
               "seed");
  }
  for (const double weight : {0.5, 1.0}) {
    const msq::FoamSeeds seeds(0, 1, {1, 1, 1}, weight);
    const double seconds = bench::median_seconds([&] {
      for_each_brick([&](msq::CellIndex at) { msq::EdgeBrick::of_weighted(seeds, at); });
    });
    report.add("edges of 32^3 seeds, cubes, weight " + std::to_string(weight).substr(0, 3), seconds,
               side * side * side, "seed");
  }
}

void bench_edges(bench::Report& report) {
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  const double count = side * side * side;
  size_t edges = 0;
  const double ours = bench::median_seconds([&] {
    edges = 0;
    for_each_brick(
        [&](msq::CellIndex at) { edges += msq::EdgeBrick(seeds, at).segments().count(); });
  });
  report.add("edges of 32^3 seeds, msq, one thread", ours, count, "seed");
  const double by_cells = bench::median_seconds(
      [&] { for_each_brick([&](msq::CellIndex at) { msq::EdgeBrick::by_cells(seeds, at); }); });
  report.add("edges of 32^3 seeds, msq by Voronoi cells", by_cells, count, "seed");
  report.note("by tetrahedra against by cells", by_cells / ours, "times faster");
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

void bench_slices(bench::Report& report, uint32_t largest) {
  for (uint32_t resolution = 512; resolution <= largest; resolution *= 2)
    for (int cells : {32, 128, 256}) {
      double peak;
      const double seconds =
          bench::foam_slice_seconds({cells, MSQ_FOAM_DIRECT}, resolution, UINT64_MAX, peak);
      report.add("DIRECT, " + bench::foam_work(resolution, cells), seconds,
                 std::pow(double(resolution), 3), "sample");
      report.note("  peak memory", peak / 1e6, "MB");
    }
}

/// Closed cells, and cells with holes.
void bench_walls(bench::Report& report, uint32_t resolution) {
  for (int cells : {32, 128})
    for (double vent : {0.0, 0.15}) {
      bench::FoamSetup setup{cells, MSQ_FOAM_DIRECT};
      setup.wall = 0.1;
      setup.vent = vent;
      double peak;
      const double seconds = bench::foam_slice_seconds(setup, resolution, UINT64_MAX, peak);
      const std::string name =
          vent > 0 ? "walls of 0.1 cell, holes of 0.15, " : "walls of 0.1 cell, ";
      report.add(name + bench::foam_work(resolution, cells), seconds,
                 std::pow(double(resolution), 3), "sample");
      report.note("  peak memory", peak / 1e6, "MB");
    }
}

/// Power diagrams against Voronoi diagrams.
void bench_weights(bench::Report& report, uint32_t resolution) {
  for (int cells : {32, 128})
    for (double wall : {0.0, 0.1}) {
      double plain = 0;
      for (double weight : {0.0, 0.5, 1.0}) {
        bench::FoamSetup setup{cells, MSQ_FOAM_DIRECT};
        setup.wall = wall;
        setup.weight = weight;
        double peak;
        const double seconds = bench::foam_slice_seconds(setup, resolution, UINT64_MAX, peak);
        char name[64];
        std::snprintf(name, sizeof name, "%s, weight %g cell, ", wall > 0 ? "walls" : "struts",
                      weight);
        report.add(name + bench::foam_work(resolution, cells), seconds,
                   std::pow(double(resolution), 3), "sample");
        if (weight > 0)
          report.note("  against no weight", seconds / plain, "times the time");
        else
          plain = seconds;
      }
    }
}

/// What fields of r, and AVX2 in place of wider vectors, cost.
void bench_variants(bench::Report& report, uint32_t resolution) {
  const double samples = std::pow(double(resolution), 3);
  double peak;
  for (int cells : {32, 256}) {
    bench::FoamSetup setup{cells, MSQ_FOAM_DIRECT};
    const std::string name = "DIRECT, " + bench::foam_work(resolution, cells);
    const auto seconds = [&] {
      return bench::foam_slice_seconds(setup, resolution, UINT64_MAX, peak);
    };
    const double constant = seconds();
    setup.is_graded = true;
    const double graded = seconds();
    setup.is_graded = false;
    report.add(name + ", gradient of r", graded, samples, "sample");
    report.note("  against constant r", graded / constant, "times the time");
    for (uint64_t sampled : {16, 128}) {
      setup.samples = sampled;
      const double waving = seconds();
      report.add(name + ", r by a grid of " + std::to_string(sampled) + "^3", waving, samples,
                 "sample");
      report.note("  against constant r", waving / constant, "times the time");
    }
    setup.samples = 0;
    setup.is_formula = true;
    const double formula = seconds();
    setup.is_formula = false;
    report.add(name + ", r by an expression", formula, samples, "sample");
    report.note("  against constant r", formula / constant, "times the time");
    if (!(hwy::SupportedTargets() & HWY_AVX2)) continue;
    hwy::SetSupportedTargetsForTest(HWY_AVX2);
    const double avx2 = seconds();
    hwy::SetSupportedTargetsForTest(0);
    report.add(name + ", AVX2", avx2, samples, "sample");
    report.note("  against all instruction sets", avx2 / constant, "times the time");
  }
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Voronoi foams, r = 0.1 cell");
  bench_edges(report);
  bench_grids(report);
  const uint32_t largest = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  if (largest > 0) {
    bench_slices(report, largest);
    bench_walls(report, largest);
    bench_weights(report, largest);
    bench_variants(report, largest);
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
