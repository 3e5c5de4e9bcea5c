// SPDX-License-Identifier: Apache-2.0
// The paper's two tables of times, in processor time of one thread: a cube filled with each kind of
// fine structure, sliced by the point query and by the set query, and what a Voronoi foam costs per
// cell and per point. Source: Igouchkine and Liu, "Set-based queries for multiscale shape-material
// modeling", section "Results".
//
// usage: paper_tables [results.json] [largest slices: 512, 1024 or 2048 (default)]
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/random.h"
#include "foam_setup.h"
#include "paper_point.h"
#include "structure/foam/seeds/seeds.h"

namespace {

using bench::check;
using bench::min_processor_seconds;

/// The paper's fine structures. The radius of struts is 0.1 cell; the function is the gyroid at
/// level 0.
enum class Fine { none, unit_cell, function, foam };

const char* name_of(Fine fine) {
  switch (fine) {
    case Fine::unit_cell:
      return "unit cells";
    case Fine::function:
      return "function";
    case Fine::foam:
      return "Voronoi foam";
    default:
      return "none";
  }
}

/// Null for none.
msq_structure* make_structure(msq_context* context, Fine fine, int cells) {
  const double cell = 1.0 / cells;
  msq_structure* structure = nullptr;
  if (fine == Fine::unit_cell) {
    msq_lattice_def def;
    check(msq_lattice_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = cell;
    def.radius.value = 0.1 * cell;
    check(msq_structure_lattice(context, &def, &structure));
  } else if (fine == Fine::function) {
    msq_functional_def def;
    check(msq_functional_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = cell;
    check(msq_structure_functional(context, &def, &structure));
  } else if (fine == Fine::foam) {
    msq_foam_def def;
    check(msq_foam_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = cell;
    def.radius.value = 0.1 * cell;
    check(msq_structure_foam(context, &def, &structure));
  }
  return structure;
}

/// A row of the first table: one structure, one number of cells.
class Solid {
 public:
  Solid(Fine fine, int cells) : context_(bench::make_context(1)) {
    model_ = bench::make_model(context_, bench::make_cube(context_),
                               make_structure(context_, fine, cells));
  }
  ~Solid() {
    msq_model_release(model_);
    msq_context_release(context_);
  }
  Solid(const Solid&) = delete;

  /// Seconds a sample of msq_point_membership, along 16 rows of a grid of resolution^3 samples.
  double point_seconds(uint32_t resolution) const {
    constexpr int rows = 16;
    const double pitch = 1.0 / resolution;
    const double seconds = min_processor_seconds([&] {
      size_t inside = 0;
      for (int row = 0; row < rows; ++row) {
        const uint64_t place = msq::splitmix_finalise(static_cast<uint64_t>(row) + 1);
        double p[3] = {0, (static_cast<double>(place % resolution) + 0.5) * pitch,
                       (static_cast<double>((place >> 32) % resolution) + 0.5) * pitch};
        for (uint32_t i = 0; i < resolution; ++i) {
          p[0] = (i + 0.5) * pitch;
          int32_t is_inside;
          check(msq_point_membership(model_, p, nullptr, &is_inside));
          inside += is_inside != 0;
        }
      }
      reader_sum += inside;
    });
    return seconds / rows / resolution;
  }

  /// Seconds of all layers of resolution^3 samples, from an empty cache; found from the first part
  /// of them.
  double slice_seconds(uint32_t resolution, uint32_t part) const {
    msq_slicer* slicer = bench::make_slicer(model_, bench::slices_of(resolution));
    bench::Reader reader;
    const double seconds = min_processor_seconds([&] {
      check(msq_cache_clear(context_));
      check(msq_slicer_run(slicer, 0, resolution / part, bench::Reader::take, &reader, nullptr));
    });
    msq_slicer_release(slicer);
    return part * seconds;
  }

  mutable size_t reader_sum = 0;

 private:
  msq_context* context_;
  msq_model* model_;
};

/// Seconds of the first `part` cells along each axis with side^3 samples each, by a method for
/// foams.
double part_seconds(int cells, uint32_t side, int part, int32_t method) {
  double peak;
  return bench::foam_slice_seconds({cells, method, 1 << 30, 1, double(part) / cells},
                                   side * static_cast<uint32_t>(part), UINT64_MAX, peak,
                                   min_processor_seconds);
}

/// Seconds a sample of the paper's own point query, at random points.
double paper_point_seconds(bench::Report& report) {
  constexpr int points = 2000, cells_across = 32;
  const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
  size_t inside = 0;
  const double seconds = min_processor_seconds([&] {
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
  report.add("the paper's point query, 2000 random points", seconds, points, "sample");
  report.note("  part inside", static_cast<double>(inside) / points, "");
  return seconds / points;
}

/// The first table. A work is "structure; cells along a side; query; samples along a side".
void bench_slices(bench::Report& report, uint32_t most, double paper_point) {
  for (const Fine fine : {Fine::none, Fine::unit_cell, Fine::function, Fine::foam})
    for (const int cells : {32, 128, 256}) {
      if (fine == Fine::none && cells > 32) continue;
      const Solid solid(fine, cells);
      for (const uint32_t resolution : {512u, 1024u, 2048u}) {
        if (resolution > most) continue;
        const double total = std::pow(static_cast<double>(resolution), 3);
        const auto add = [&](const std::string& query, double seconds) {
          report.add(std::string(name_of(fine)) + "; " + std::to_string(cells) + "; " + query +
                         "; " + std::to_string(resolution),
                     seconds, total, "sample");
        };
        add("point", total * solid.point_seconds(resolution));
        const double set = solid.slice_seconds(resolution, resolution > 1024 ? 8 : 1);
        add("set", set);
        if (fine != Fine::foam) continue;
        add("point of the paper", total * paper_point);
        report.note("  against set", total * paper_point / set, "times as long");
        // From a few cells at the corner of the cube.
        const int part = cells == 32 ? 4 : 8;
        const double parts = std::pow(double(cells) / part, 3);
        const uint32_t side = resolution / static_cast<uint32_t>(cells);
        const auto add_method = [&](const char* method_name, int32_t method) {
          const double seconds = parts * part_seconds(cells, side, part, method);
          add(method_name, seconds);
          report.note("  against set", seconds / set, "times as long");
        };
        add_method("METHOD_1", MSQ_FOAM_METHOD_1);
#if MSQ_WITH_CGAL
        add_method("METHOD_2", MSQ_FOAM_METHOD_2);
#endif
      }
    }
}

/// The second table: a line through the times per cell of few and of many samples. The last column
/// is the number of samples in a cell from which the set query is faster than `point` seconds a
/// sample.
void bench_details(bench::Report& report, double paper_point) {
  const double point = Solid(Fine::foam, 32).point_seconds(512);
  report.add("details; point", point, 1, "sample");
  const auto add = [&](const char* name, int32_t method, int part, uint32_t few, uint32_t many,
                       double alone) {
    const double cells = std::pow(double(part), 3);
    const double low = part_seconds(32, few, part, method) / cells,
                 high = part_seconds(32, many, part, method) / cells;
    const double few_samples = std::pow(double(few), 3), many_samples = std::pow(double(many), 3);
    const double per_point = (high - low) / (many_samples - few_samples),
                 per_cell = std::max(0.0, low - per_point * few_samples);
    report.add(std::string("details; ") + name + "; per cell", per_cell, 1, "cell");
    report.add(std::string("details; ") + name + "; per point", per_point, 1, "sample");
    report.note(std::string("details; ") + name + "; points per cell",
                per_cell / (alone - per_point), "");
  };
  // Fewer samples of DIRECT are evaluated one by one; more cells, since it is fast.
  add("set", MSQ_FOAM_DIRECT, 32, 8, 32, point);
  add("METHOD_1", MSQ_FOAM_METHOD_1, 8, 4, 24, paper_point);
#if MSQ_WITH_CGAL
  add("METHOD_2", MSQ_FOAM_METHOD_2, 8, 4, 24, paper_point);
#endif
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("The paper's tables, processor time of one thread");
  const double paper_point = paper_point_seconds(report);
  const double point = part_seconds(32, 6, 3, MSQ_FOAM_POINT) / (18 * 18 * 18);
  report.add("POINT, 18^3 samples of 3^3 cells", point * 18 * 18 * 18, 18 * 18 * 18, "sample");
  bench_details(report, paper_point);
  bench_slices(report, count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048,
               paper_point);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
