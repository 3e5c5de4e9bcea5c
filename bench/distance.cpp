// SPDX-License-Identifier: Apache-2.0
// Signed distances of 10^5 random points: a closed mesh of 270,000 triangles, a lattice and foams
// of 32^3 cells, one thread. Also what the tree of the mesh costs. Membership of the same points
// beside them.
#include <cmath>
#include <random>

#include "rippled_torus.h"
#include "setup.h"

namespace {

constexpr double cell = 1.0 / 32;

msq_model* lattice(msq_context* context, int32_t unit_cell) {
  msq_lattice_def def;
  bench::check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  for (double& size : def.grid.cell_size) size = cell;
  def.radius.value = 0.1 * cell;
  msq_structure* structure;
  bench::check(msq_structure_lattice(context, &def, &structure));
  return bench::make_model(context, bench::make_cube(context), structure);
}

msq_model* foam(msq_context* context, double jitter) {
  msq_foam_def def;
  bench::check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = cell;
  def.radius.value = 0.1 * cell;
  def.jitter = jitter;
  msq_structure* structure;
  bench::check(msq_structure_foam(context, &def, &structure));
  return bench::make_model(context, bench::make_cube(context), structure);
}

uint64_t bytes_of(msq_context* context) {
  msq_memory_report report{};
  report.struct_size = sizeof report;
  bench::check(msq_context_memory(context, &report));
  return report.bytes;
}

struct Points {
  msq_points_def def;
  size_t count;
};

void measure(bench::Report& report, const std::string& name, msq_model* model,
             const Points& points) {
  std::vector<double> distance(points.count);
  std::vector<uint8_t> inside(points.count);
  const double units = static_cast<double>(points.count);
  report.add(name + ": distance", bench::median_seconds([&] {
               bench::check(msq_set_distance(model, &points.def, nullptr, distance.data(),
                                             distance.size(), nullptr));
             }),
             units, "point");
  report.add(name + ": membership", bench::median_seconds([&] {
               bench::check(msq_set_membership(model, &points.def, nullptr, inside.data(),
                                               inside.size(), nullptr));
             }),
             units, "point");
  size_t differ = 0;
  for (size_t i = 0; i < points.count; ++i) differ += (distance[i] <= 0) != inside[i];
  if (differ) throw std::runtime_error("signs differ from membership");
  msq_model_release(model);
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("signed distances, one thread");
  msq_context* context = bench::make_context(1);

  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> coordinates(300000);
  for (double& c : coordinates) c = uniform(random);
  Points anywhere{{}, coordinates.size() / 3};
  bench::check(msq_points_def_init(&anywhere.def, sizeof anywhere.def));
  anywhere.def.coordinates = coordinates.data();
  anywhere.def.count = anywhere.count;
  Points grid{{}, 64 * 64 * 64};
  bench::check(msq_points_def_init(&grid.def, sizeof grid.def));
  grid.def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    grid.def.origin[axis] = 0.5 / 64;
    grid.def.spacing[axis] = 1.0 / 64;
    grid.def.counts[axis] = 64;
  }

  msq_model* mesh = bench::make_model(
      context, bench::make_shape(context, bench::rippled_torus(520, 260)), nullptr);
  const uint64_t before = bytes_of(context);
  const double middle[3] = {0.5, 0.5, 0.5};
  double distance;
  const double building = bench::seconds_of(
      [&] { bench::check(msq_point_distance(mesh, middle, nullptr, &distance)); });
  report.add("mesh of 270,400 triangles: tree", building, 270400, "triangle");
  report.note("held by the tree", static_cast<double>(bytes_of(context) - before) / 270400,
              "bytes a triangle");
  measure(report, "mesh of 270,400 triangles", mesh, anywhere);
  measure(report, "BCC lattice", lattice(context, MSQ_UNIT_CELL_BCC), anywhere);
  measure(report, "octet lattice", lattice(context, MSQ_UNIT_CELL_OCTET), anywhere);
  measure(report, "foam, jitter 1", foam(context, 1), anywhere);
  measure(report, "foam, jitter 0.01", foam(context, 0.01), anywhere);
  measure(report, "foam, jitter 1, grid of 8 points a cell", foam(context, 1), grid);
  msq_context_release(context);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
