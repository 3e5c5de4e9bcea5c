// SPDX-License-Identifier: Apache-2.0
// DIRECT against the paper's methods: Voronoi foams, r = 0.1 cell, in the unit cube, one thread.
//
// usage: foam_methods [results.json]
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <string>

#include "base/random.h"
#include "foam_setup.h"
#include "paper_point.h"
#include "structure/foam/seeds/seeds.h"

namespace {

/// Median processor time of three runs of one thread's work, or of one that takes long: other work
/// on the machine hardly changes it.
double processor_seconds(const std::function<void()>& work) {
  std::vector<double> times;
  do {
    const std::clock_t start = std::clock();
    work();
    times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  } while (times.size() < 3 && times[0] < 1);
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// Processor time of one thread for `layers` layers of the first `part` cells along each axis, each
/// with samples^3 samples, from an empty cache.
double part_seconds(int cells, uint32_t samples, int part, uint64_t layers, int32_t method) {
  double peak;
  return bench::foam_slice_seconds({cells, method, 1 << 30, 1, double(part) / cells},
                                   samples * static_cast<uint32_t>(part), layers, peak,
                                   processor_seconds);
}

/// Seconds a sample of the paper's own point query, at random points.
double paper_point_seconds(bench::Report& report) {
  constexpr int points = 2000, cells_across = 32;
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  size_t inside = 0;
  const double seconds = processor_seconds([&] {
    inside = 0;
    uint64_t state = 1;
    const auto coordinate = [&] {
      state = msq::splitmix_finalise(state + 1);
      return static_cast<double>(state >> 11) * 0x1p-53 * cells_across;
    };
    for (int i = 0; i < points; ++i) {
      const double x = coordinate(), y = coordinate(), z = coordinate();
      inside += bench::paper_point_inside(seeds, {x, y, z}, 0.1);
    }
  });
  report.add("POINT as the paper has it, 2000 random points", seconds, points, "sample");
  report.note("  part inside", static_cast<double>(inside) / points, "");
  return seconds / points;
}

/// The paper's methods against DIRECT, processor time of one thread. They are measured on a few
/// cells from one corner of the cube, and DIRECT, where it takes long, on a quarter of the layers;
/// all times are scaled up to the whole cube.
void bench_methods(bench::Report& report) {
  const double paper = paper_point_seconds(report);
  const double point = part_seconds(32, 6, 3, UINT64_MAX, MSQ_FOAM_POINT) / (18 * 18 * 18);
  report.add("POINT, 18^3 samples of 3^3 cells", point * 18 * 18 * 18, 18 * 18 * 18, "sample");
  for (uint32_t resolution : {512u, 1024u})
    for (int cells : {32, 128, 256}) {
      const uint32_t samples = resolution / static_cast<uint32_t>(cells);
      const double total = std::pow(static_cast<double>(resolution), 3);
      const std::string name = bench::foam_work(resolution, cells);
      const uint32_t share = static_cast<uint32_t>(cells) * resolution > 256u * 512u ? 4 : 1;
      const double direct =
          share * part_seconds(cells, samples, cells, resolution / share, MSQ_FOAM_DIRECT);
      report.add(
          std::string("DIRECT, one thread, ") + (share == 1 ? "" : "from a quarter of ") + name,
          direct, total, "sample");
      report.note("  POINT as the paper has it", paper * total / direct, "times as long");
      report.note("  POINT", point * total / direct, "times as long");
      const int part = cells == 32 ? 4 : 8;
      const double parts = std::pow(double(cells) / part, 3);
      const auto bench_method = [&](const char* method_name, int32_t method) {
        const double seconds = parts * part_seconds(cells, samples, part, UINT64_MAX, method);
        report.add(
            std::string(method_name) + ", from " + std::to_string(part) + "^3 cells of " + name,
            seconds, total, "sample");
        report.note("  against DIRECT", seconds / direct, "times as long");
      };
      bench_method("METHOD_1", MSQ_FOAM_METHOD_1);
#if MSQ_WITH_CGAL
      bench_method("METHOD_2", MSQ_FOAM_METHOD_2);
#endif
    }
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Methods for Voronoi foams, r = 0.1 cell, one thread");
  bench_methods(report);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
