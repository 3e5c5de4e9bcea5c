// SPDX-License-Identifier: Apache-2.0
// Foams asked point by point: sets of random points in no order, and grids of few samples a cell.
// r = 0.1 cell, in the unit cube, two threads.
//
// usage: points [results.json] [millions of points, default 10] [0: sets alone]
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/random.h"
#include "query/array_points.h"
#include "query/point_groups.h"
#include "setup.h"
#include "structure/foam/foam.h"
#include "structure/foam/sets/point_set.h"
#include "varied_structures.h"

namespace {

struct Foam {
  msq_context* context;
  msq_model* model;
};

Foam make_foam(int cells, int32_t method) {
  Foam foam{};
  foam.context = bench::make_context();
  msq_foam_def def;
  bench::check(msq_foam_def_init(&def, sizeof def));
  def.method = method;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_structure* structure;
  bench::check(msq_structure_foam(foam.context, &def, &structure));
  foam.model = bench::make_model(foam.context, bench::make_cube(foam.context), structure);
  return foam;
}

void release(const Foam& foam) {
  msq_model_release(foam.model);
  msq_context_release(foam.context);
}

std::vector<double> random_points(size_t count) {
  std::vector<double> coordinates(3 * count);
  for (size_t i = 0; i < coordinates.size(); ++i)
    coordinates[i] = static_cast<double>(msq::splitmix_output(1, i) >> 11) * 0x1p-53;
  return coordinates;
}

void bench_grouping(bench::Report& report, int cells, const std::vector<double>& coordinates) {
  const msq::Executor executor(2);
  const size_t count = coordinates.size() / 3;
  const msq::ArrayPoints points({reinterpret_cast<const unsigned char*>(coordinates.data()), count,
                                 3 * sizeof(double), false});
  constexpr size_t chunk = size_t{1} << 21;
  msq::Neighbourhood grid;
  for (int axis = 0; axis < 3; ++axis) grid.cell_size[axis] = 1.0 / cells;
  const std::vector<uint8_t> alive(count, 1);
  msq::PointGroups groups(chunk);
  const auto group_all = [&] {
    for (size_t first = 0; first < count; first += chunk)
      groups.group(executor, grid, points, first, std::min(chunk, count - first),
                   alive.data() + first, nullptr);
  };
  const double seconds = bench::median_seconds(group_all);
  report.add("  grouping alone", seconds, static_cast<double>(count), "point");
  const double processor = bench::processor_seconds_of(group_all);
  report.note("  processor time of all threads", processor / static_cast<double>(count) * 1e9,
              "ns / point");
  report.mark("  grouping on two threads, by processor time",
              2 * static_cast<double>(count) / processor / 1e6, "million points / s", 50, true);
}

msq_points_def array_of(const std::vector<double>& coordinates, size_t count) {
  msq_points_def points;
  bench::check(msq_points_def_init(&points, sizeof points));
  points.coordinates = coordinates.data();
  points.count = count;
  return points;
}

/// Median seconds of a set query.
double set_seconds(const Foam& foam, const msq_points_def& points, int32_t method,
                   uint32_t group_parts, std::vector<uint8_t>& inside, msq_job* job = nullptr) {
  msq_query_def query;
  bench::check(msq_query_def_init(&query, sizeof query));
  query.method = method;
  query.group_parts = group_parts;
  return bench::median_seconds([&] {
    bench::check(
        msq_set_membership(foam.model, &points, &query, inside.data(), inside.size(), job));
  });
}

/// The paper's point query, each point by itself: processor time of a point.
double paper_seconds(int cells, const std::vector<double>& coordinates) {
  const size_t count = 2000;
  const Foam foam = make_foam(cells, MSQ_FOAM_POINT);
  std::vector<uint8_t> inside(count);
  const msq_points_def points = array_of(coordinates, count);
  const double seconds = bench::processor_seconds_of([&] {
    bench::check(
        msq_set_membership(foam.model, &points, nullptr, inside.data(), inside.size(), nullptr));
  });
  release(foam);
  return seconds / static_cast<double>(count);
}

void bench_array(bench::Report& report, int cells, const std::vector<double>& coordinates) {
  const size_t count = coordinates.size() / 3;
  const double points_in_all = static_cast<double>(count);
  const std::string name = std::to_string(cells) + "^3 cells";
  const Foam foam = make_foam(cells, MSQ_FOAM_DIRECT);
  std::vector<uint8_t> inside(count);
  const msq_points_def points = array_of(coordinates, count);
  const auto ask_set = [&] {
    bench::check(
        msq_set_membership(foam.model, &points, nullptr, inside.data(), inside.size(), nullptr));
  };
  const double set = bench::median_seconds(ask_set);
  report.add("set of random points, " + name, set, points_in_all, "point");
  const double set_processor = bench::processor_seconds_of(ask_set) / points_in_all;
  report.note("  processor time of all threads", set_processor * 1e9, "ns / point");
  msq_memory_report memory{};
  memory.struct_size = sizeof memory;
  bench::check(msq_context_memory(foam.context, &memory));
  report.mark("  memory beyond the host's arrays",
              static_cast<double>(memory.peak_bytes) / points_in_all, "bytes / point", 12, false);
  bench_grouping(report, cells, coordinates);
  const size_t sample = std::min<size_t>(count, 200000);
  size_t differ = 0;
  const double alone = bench::processor_seconds_of([&] {
    for (size_t i = 0; i < sample; ++i) {
      int32_t answer;
      bench::check(msq_point_membership(foam.model, &coordinates[3 * i], nullptr, &answer));
      differ += answer != inside[i];
    }
  });
  const double one_by_one = alone / static_cast<double>(sample);
  report.add("  one by one, msq_point_membership, one thread", alone, static_cast<double>(sample),
             "point");
  report.note("  answers that differ", static_cast<double>(differ), "");
  const double paper = paper_seconds(cells, coordinates);
  report.note("  the paper's point query (MSQ_FOAM_POINT), processor time", paper * 1e9,
              "ns / point");
  report.mark("  set against the paper's point query, by processor time", paper / set_processor,
              "times faster", 20, true);
  report.mark("  set on two threads against msq_point_membership on one",
              2 * one_by_one / set_processor, "times faster", 20, true);
  report.note("  the same, both on one thread", one_by_one / set_processor, "times faster");
  release(foam);
}

/// Many points a cell, grouped by cells and by parts of cells.
void bench_parts(bench::Report& report, const std::vector<double>& coordinates) {
  const size_t count = coordinates.size() / 3;
  const Foam foam = make_foam(4, MSQ_FOAM_DIRECT);
  std::vector<uint8_t> inside(count);
  const msq_points_def points = array_of(coordinates, count);
  for (uint32_t parts : {1u, 4u}) {
    msq_query_def query;
    bench::check(msq_query_def_init(&query, sizeof query));
    query.group_parts = parts;
    const auto ask = [&] {
      bench::check(
          msq_set_membership(foam.model, &points, &query, inside.data(), inside.size(), nullptr));
    };
    ask();
    report.note("4^3 cells, by " + std::to_string(parts) + "^3 parts of a cell, processor time",
                bench::processor_seconds_of(ask) / static_cast<double>(count) * 1e9, "ns / point");
  }
  release(foam);
}

/// A foam around an axis of which a point asks two parts, beside the parts alone.
void bench_two_parts(bench::Report& report, const std::vector<double>& coordinates) {
  const size_t count = std::min<size_t>(coordinates.size() / 3, 20000);
  constexpr int cells = 8;
  const auto seconds = [&](double radius, double wall_thickness) {
    msq_context* const context = bench::make_context();
    const msq_warp_def warp = bench::around_axis(cells);
    msq_structure* const structure = bench::changed_foam(context, cells, [&](msq_foam_def& def) {
      def.radius.value = radius / cells;
      def.wall_thickness.value = wall_thickness / cells;
      def.warp = &warp;
    });
    msq_model* const model = bench::make_model(context, bench::make_cube(context), structure);
    const auto ask = [&] {
      int32_t answer;
      for (size_t i = 0; i < count; ++i)
        bench::check(msq_point_membership(model, &coordinates[3 * i], nullptr, &answer));
    };
    ask();
    const double taken = bench::processor_seconds_of(ask) / static_cast<double>(count);
    release({context, model});
    return taken;
  };
  const double struts = seconds(0.1, 0), walls = seconds(0, 0.1), both = seconds(0.1, 0.1);
  report.note("foam around an axis, msq_point_membership: struts", struts * 1e9, "ns / point");
  report.note("  walls", walls * 1e9, "ns / point");
  report.mark("  struts and walls, against the sum", both / (struts + walls), "", 1.5, false);
}

/// As many points as in the array, some in each of the foam's cells.
void bench_stratified(bench::Report& report, int cells, size_t count) {
  const Foam foam = make_foam(cells, MSQ_FOAM_DIRECT);
  const uint64_t side = 2 * static_cast<uint64_t>(cells);
  msq_points_def points;
  bench::check(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_STRATIFIED;
  points.per_cell = static_cast<uint32_t>(
      std::max<double>(1, std::round(static_cast<double>(count) / std::pow(side, 3))));
  for (int axis = 0; axis < 3; ++axis) {
    points.counts[axis] = side;
    points.spacing[axis] = 1.0 / static_cast<double>(side);
  }
  const uint64_t all = side * side * side * points.per_cell;
  std::vector<uint8_t> inside(all);
  msq_job* job;
  bench::check(msq_job_create(&job));
  const double seconds = set_seconds(foam, points, MSQ_QUERY_AUTO, 0, inside, job);
  report.add("stratified points, " + std::to_string(points.per_cell) + " in each of (2 * " +
                 std::to_string(cells) + ")^3 strata",
             seconds, static_cast<double>(all), "point");
  report.note("  processor time of all threads",
              bench::processor_seconds_of([&] {
                bench::check(msq_set_membership(foam.model, &points, nullptr, inside.data(),
                                                inside.size(), job));
              }) / static_cast<double>(all) *
                  1e9,
              "ns / point");
  msq_job_report counts{};
  counts.struct_size = sizeof counts;
  bench::check(msq_job_info(job, &counts));
  report.note("  points a group",
              static_cast<double>(counts.by_set) / static_cast<double>(counts.groups), "");
  msq_job_release(job);
  release(foam);
}

constexpr uint32_t resolution = 512;
constexpr uint64_t layers = resolution / 8;

/// Slices by DIRECT, which asks samples one by one below its critical count.
void bench_slices(bench::Report& report, int cells) {
  const Foam foam = make_foam(cells, MSQ_FOAM_DIRECT);
  msq_slicer* slicer = bench::make_slicer(foam.model, bench::slices_of(resolution));
  bench::Reader reader;
  const auto slice = [&] {
    reader = {};
    bench::check(msq_cache_clear(foam.context));
    bench::check(msq_slicer_run(slicer, 0, layers, bench::Reader::take, &reader, nullptr));
  };
  const double seconds = bench::median_seconds(slice);
  const double samples = static_cast<double>(resolution) * resolution * static_cast<double>(layers);
  report.add("an eighth of 512^3, " + std::to_string(cells) + "^3 cells, DIRECT", seconds, samples,
             "sample");
  report.note("  processor time of all threads", bench::processor_seconds_of(slice) / samples * 1e9,
              "ns / sample");
  report.note("  volume fraction", static_cast<double>(reader.inside) / samples, "");
  msq_slicer_release(slicer);
  release(foam);
}

/// The same samples, each asked.
void bench_rows(bench::Report& report, int cells) {
  const auto context = msq::make_ref<msq::Context>(2u, uint64_t{0}, uint64_t{0});
  msq::Neighbourhood grid;
  for (int axis = 0; axis < 3; ++axis) grid.cell_size[axis] = 1.0 / cells;
  const msq::Foam foam(context, grid, msq::Parameter(0.1 / cells), 1, 0, msq::FoamMethod::direct);
  msq::SampleGrid samples_at;
  samples_at.nx = samples_at.ny = resolution;
  samples_at.nz = layers;
  for (int axis = 0; axis < 3; ++axis) {
    samples_at.spacing[axis] = 1.0 / resolution;
    samples_at.origin[axis] = 0.5 / resolution;
  }
  const uint64_t rows = 64, deep = std::max<uint64_t>(1, resolution / static_cast<unsigned>(cells));
  const uint64_t across = resolution / rows, slabs = (layers + deep - 1) / deep;
  const auto ask = [&] {
    context->executor.for_each(across * slabs, [&](uint64_t task) {
      msq::RowBlock block;
      block.grid = &samples_at;
      block.y0 = task % across * rows;
      block.y1 = block.y0 + rows;
      block.z0 = task / across * deep;
      block.z1 = std::min(layers, block.z0 + deep);
      block.row_stride = block.row_words();
      block.layer_stride = block.row_stride * rows;
      std::vector<uint64_t> words(block.layer_stride * block.layers(), ~uint64_t{0});
      block.words = words.data();
      msq::foam_keep_rows_by_point(foam, block, nullptr);
    });
  };
  const double seconds = bench::median_seconds(ask);
  const double samples = static_cast<double>(resolution) * resolution * static_cast<double>(layers);
  report.add("  each sample asked", seconds, samples, "sample");
  report.note("  processor time of all threads", bench::processor_seconds_of(ask) / samples * 1e9,
              "ns / sample");
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Voronoi foams point by point, r = 0.1 cell");
  const size_t millions = count > 2 ? static_cast<size_t>(std::atoi(arguments[2])) : 10;
  {
    const std::vector<double> coordinates = random_points(millions * 1000000);
    for (int cells : {32, 128}) bench_array(report, cells, coordinates);
    bench_parts(report, coordinates);
    bench_two_parts(report, coordinates);
    for (int cells : {32, 128}) bench_stratified(report, cells, coordinates.size() / 3);
  }
  // From 2 to 6.4 samples a cell along each axis.
  const bool has_slices = count <= 3 || std::atoi(arguments[3]) != 0;
  for (int cells : {256, 160, 128, 104, 80}) {
    if (!has_slices) break;
    bench_slices(report, cells);
    bench_rows(report, cells);
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
