// SPDX-License-Identifier: Apache-2.0
// Preview meshes: triangles of a model's boundary, beside the points of the same lattice of nodes,
// and beside one point query for each crossing of an edge.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "setup.h"

namespace {

constexpr double target_seconds = 1;  // the bracket at 0.4 mm

msq_structure* make_foam(msq_context* context, double cell, double radius) {
  msq_foam_def def;
  bench::check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = cell;
  def.radius.value = radius;
  msq_structure* structure;
  bench::check(msq_structure_foam(context, &def, &structure));
  return structure;
}

msq_structure* make_octet(msq_context* context, double cell, double radius) {
  msq_lattice_def def;
  bench::check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_OCTET;
  for (double& size : def.grid.cell_size) size = cell;
  def.radius.value = radius;
  msq_structure* structure;
  bench::check(msq_structure_lattice(context, &def, &structure));
  return structure;
}

msq_structure* make_gyroid(msq_context* context, double cell, double thickness) {
  msq_functional_def def;
  bench::check(msq_functional_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  for (double& size : def.grid.cell_size) size = cell;
  def.thickness.value = thickness;
  msq_structure* structure;
  bench::check(msq_structure_functional(context, &def, &structure));
  return structure;
}

struct Triangles {
  uint64_t triangles = 0, vertices = 0;
  std::vector<double> places;
  static int32_t take(void* user, const msq_surface_slab* slab) {
    auto& all = *static_cast<Triangles*>(user);
    all.triangles += slab->triangle_count;
    all.vertices += slab->vertex_count;
    all.places.insert(all.places.end(), slab->vertices, slab->vertices + 3 * slab->vertex_count);
    return 0;
  }
};

void measure(bench::Report& report, const std::string& name, const msq_model* model, double pitch,
             bool has_target) {
  msq_surface_def def;
  bench::check(msq_surface_def_init(&def, sizeof def));
  def.pitch = pitch;
  Triangles mesh;
  std::vector<double> processor;
  const double seconds = bench::median_seconds([&] {
    mesh = {};
    const double start = bench::processor_seconds();
    bench::check(msq_surface_mesh(model, &def, Triangles::take, &mesh, nullptr));
    processor.push_back(bench::processor_seconds() - start);
  });
  std::nth_element(processor.begin(), processor.begin() + processor.size() / 2, processor.end());
  const double own = processor[processor.size() / 2];
  report.add(name, seconds, double(mesh.triangles), "triangle");
  report.note(name + ": triangles", double(mesh.triangles), "");
  if (has_target)
    report.mark(name + ": processor time", own, "s", target_seconds, false);
  else
    report.note(name + ": processor time", own, "s");

  // The same nodes as a grid of points.
  double min[3], max[3];
  bench::check(msq_model_bounds(model, min, max));
  msq_points_def points;
  bench::check(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_GRID;
  uint64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    points.origin[axis] = min[axis];
    points.spacing[axis] = pitch;
    points.counts[axis] = uint64_t(std::ceil((max[axis] - min[axis]) / pitch)) + 1;
    count *= points.counts[axis];
  }
  std::vector<uint8_t> inside(count);
  const double nodes = bench::median_seconds([&] {
    bench::check(
        msq_set_membership(model, &points, nullptr, inside.data(), inside.size(), nullptr));
  });
  report.add(name + ": nodes as a grid", nodes, double(count), "node");
  report.note(name + ": mesh, times its nodes", seconds / nodes, "");

  // One query per vertex, a peer that bisects needs some ten for each.
  bench::check(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_ARRAY;
  points.coordinates = mesh.places.data();
  points.count = mesh.vertices;
  inside.resize(mesh.vertices);
  const double vertices = bench::median_seconds([&] {
    bench::check(
        msq_set_membership(model, &points, nullptr, inside.data(), inside.size(), nullptr));
  });
  report.add(name + ": membership of its vertices", vertices, double(mesh.vertices), "vertex");
  report.note(name + ": mesh, times membership of its vertices", seconds / vertices, "");
}

}  // namespace

// surface [JSON [PART.stl [THREADS]]]
int main(int count, char** arguments) try {
  const char* part = count > 2 ? arguments[2] : "examples/parts/bracket.stl";
  bench::Report report("preview meshes");
  for (const uint32_t threads : {1u, 2u}) {
    if (count > 3 && std::to_string(threads) != arguments[3]) continue;
    msq_context* context = bench::make_context(threads);
    const std::string with = ", " + std::to_string(threads) + " threads";
    for (const double pitch : {0.4, 0.2}) {
      msq_shape* shape;
      bench::check(msq_shape_from_file(context, part, nullptr, &shape, nullptr));
      msq_model* model = bench::make_model(context, shape, make_foam(context, 4, 0.4));
      measure(report, "bracket with foam, pitch " + std::to_string(pitch).substr(0, 3) + with,
              model, pitch, pitch == 0.4);
      msq_model_release(model);
    }
    const auto measure_cube = [&](const std::string& name, msq_structure* structure) {
      msq_model* model = bench::make_model(context, bench::make_cube(context, 40), structure);
      measure(report, name + ", pitch 0.2" + with, model, 0.2, false);
      msq_model_release(model);
    };
    measure_cube("octet", make_octet(context, 4, 0.4));
    measure_cube("gyroid", make_gyroid(context, 4, 0.8));
    msq_context_release(context);
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
