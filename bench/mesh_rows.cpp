// SPDX-License-Identifier: Apache-2.0
// A closed mesh of 270,000 triangles sliced at 1024^3, against its own point query and CGAL's; the
// same mesh placed, and with holes. Also the memory of slabs: 2048^2 x 64 layers as bits.
#include <cmath>
#include <random>

#include "rippled_torus.h"
#include "setup.h"

#if MSQ_WITH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#endif

namespace {

struct Sliced {
  msq_context* context;
  msq_model* model;
  msq_slicer* slicer;
};

/// Turned about two axes through the middle of the unit cube.
msq_shape* turned(msq_shape* shape) {
  msq_neighbourhood grid;
  bench::turn(grid);
  double matrix[12];
  for (int i = 0; i < 3; ++i) {
    matrix[4 * i + 3] = 0.5;
    for (int j = 0; j < 3; ++j) {
      matrix[4 * i + j] = grid.rotation[3 * i + j];
      matrix[4 * i + 3] -= 0.5 * matrix[4 * i + j];
    }
  }
  msq_shape* placed;
  bench::check(msq_shape_placed(shape, matrix, &placed));
  msq_shape_release(shape);
  return placed;
}

Sliced make_slicer(const bench::MeshArrays& mesh, uint32_t resolution, uint32_t slab_layers,
                   bool is_turned = false) {
  Sliced made{};
  made.context = bench::make_context();
  msq_shape* shape = bench::make_shape(made.context, mesh);
  if (is_turned) shape = turned(shape);
  made.model = bench::make_model(made.context, shape, nullptr);
  msq_slicer_def def;
  bench::check(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = resolution;
  def.layer_count = resolution;
  def.layer_height = 1.0 / resolution;
  def.has_region = 1;
  for (double& v : def.region_max) v = 1;
  def.slab_layers = slab_layers;
  bench::check(msq_slicer_create(made.model, &def, &made.slicer));
  return made;
}

void release(const Sliced& made) {
  msq_slicer_release(made.slicer);
  msq_model_release(made.model);
  msq_context_release(made.context);
}

double peak_bytes(msq_context* context) {
  msq_memory_report report{};
  report.struct_size = sizeof report;
  bench::check(msq_context_memory(context, &report));
  return static_cast<double>(report.peak_bytes);
}

/// Without the triangles about five vertices: holes of a fifth of the torus's thickness.
bench::MeshArrays with_holes(const bench::MeshArrays& mesh) {
  bench::MeshArrays open{mesh.vertices, {}};
  const auto distance = [&](size_t a, size_t b) {
    double squared = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double d = mesh.vertices[3 * a + axis] - mesh.vertices[3 * b + axis];
      squared += d * d;
    }
    return std::sqrt(squared);
  };
  const size_t vertices = mesh.vertices.size() / 3;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    bool is_kept = true;
    for (size_t hole = 0; hole < 5; ++hole)
      is_kept = is_kept && distance(mesh.triangles[i], (2 * hole + 1) * vertices / 10) > 0.04;
    if (is_kept)
      open.triangles.insert(open.triangles.end(), &mesh.triangles[i], &mesh.triangles[i] + 3);
  }
  return open;
}

std::vector<double> random_points(size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> points(3 * count);
  for (double& c : points) c = uniform(random);
  return points;
}

#if MSQ_WITH_CGAL
double cgal_seconds(const bench::MeshArrays& mesh, const std::vector<double>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh surface;
  for (size_t i = 0; i < mesh.vertices.size(); i += 3)
    surface.add_vertex({mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]});
  for (size_t i = 0; i < mesh.triangles.size(); i += 3)
    surface.add_face(Mesh::Vertex_index(mesh.triangles[i]),
                     Mesh::Vertex_index(mesh.triangles[i + 1]),
                     Mesh::Vertex_index(mesh.triangles[i + 2]));
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(surface);
  side(Kernel::Point_3(0.5, 0.5, 0.5));  // builds its tree
  size_t inside = 0;
  return bench::seconds_of([&] {
    for (size_t i = 0; i < points.size(); i += 3)
      inside +=
          side(Kernel::Point_3(points[i], points[i + 1], points[i + 2])) != CGAL::ON_UNBOUNDED_SIDE;
  });
}
#endif

}  // namespace

int main(int count, char** arguments) try {
  const bench::MeshArrays mesh = bench::rippled_torus(520, 260);
  bench::Report report("mesh of " + std::to_string(mesh.triangles.size() / 3) + " triangles");
  const double rows = 1024.0 * 1024.0;
  const Sliced sliced = make_slicer(mesh, 1024, 0);
  bench::Reader reader;
  const double slicing = bench::median_seconds([&] {
    bench::check(
        msq_slicer_run(sliced.slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  report.add("slices 1024^3 as bits", slicing, rows, "row");
  const Sliced placed = make_slicer(mesh, 1024, 0, true);
  const double slicing_placed = bench::median_seconds([&] {
    bench::check(
        msq_slicer_run(placed.slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  report.add("slices 1024^3 as bits, mesh placed by a rotation", slicing_placed, rows, "row");
  report.note("  that against the mesh as it is", slicing_placed / slicing, "times the time");
  release(placed);
  const Sliced open = make_slicer(with_holes(mesh), 1024, 0);
  const double slicing_open = bench::median_seconds([&] {
    bench::check(msq_slicer_run(open.slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  report.add("slices 1024^3 as bits, mesh with five holes", slicing_open, rows, "row");
  report.note("  that against the closed mesh", slicing_open / slicing, "times the time");
  release(open);

  const std::vector<double> points = random_points(1000000);
  std::vector<uint8_t> inside(points.size() / 3);
  msq_points_def set;
  bench::check(msq_points_def_init(&set, sizeof set));
  set.coordinates = points.data();
  set.count = inside.size();
  const double array = bench::median_seconds([&] {
    bench::check(
        msq_set_membership(sliced.model, &set, nullptr, inside.data(), inside.size(), nullptr));
  });
  report.add("random points, 1e6, set query", array, 1e6, "point");
  report.note("slices against that query, for the same samples", array * 1073.741824 / slicing,
              "times faster");
#if MSQ_WITH_CGAL
  const std::vector<double> few(points.begin(), points.begin() + 300000);
  const double cgal = cgal_seconds(mesh, few);
  report.add("random points, 1e5, CGAL Side_of_triangle_mesh, one thread", cgal, 1e5, "point");
  report.note("slices against CGAL, for the same samples", cgal * 10737.41824 / slicing,
              "times faster");
#endif
  release(sliced);

  const Sliced slabs = make_slicer(mesh, 2048, 64);
  msq_memory_report before{};
  before.struct_size = sizeof before;
  bench::check(msq_context_memory(slabs.context, &before));
  bench::check(msq_slicer_run(slabs.slicer, 512, 256, bench::Reader::take, &reader, nullptr));
  report.note("slabs of 2048^2 x 64 layers as bits, peak beyond the mesh",
              (peak_bytes(slabs.context) - static_cast<double>(before.bytes)) / 1e6, "MB");
  release(slabs);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
