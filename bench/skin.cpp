// SPDX-License-Identifier: Apache-2.0
// Slices at 1024^3 with a skin about a structure of empty space except for hair-thin struts: under
// a mesh of 270,000 triangles, a box and a cylinder, against the same without a skin. Two threads.
#include <cstdlib>

#include "rippled_torus.h"
#include "setup.h"

namespace {

msq_structure* thin_lattice(msq_context* context) {
  msq_lattice_def def;
  bench::check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  for (double& size : def.grid.cell_size) size = 0.25;
  def.radius.value = 0.002;
  msq_structure* structure;
  bench::check(msq_structure_lattice(context, &def, &structure));
  return structure;
}

double slice(msq_context* context, msq_shape* shape, const msq_param& skin, uint32_t resolution) {
  msq_shape_retain(shape);
  msq_model* model = bench::make_model(context, shape, thin_lattice(context), skin);
  const double middle[3] = {0.5, 0.5, 0.5};  // builds the tree of a mesh
  double distance;
  bench::check(msq_point_distance(model, middle, nullptr, &distance));
  msq_slicer_def def;
  bench::check(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = resolution;
  def.layer_count = resolution;
  def.layer_height = 1.0 / resolution;
  def.has_region = 1;
  for (double& v : def.region_max) v = 1;
  msq_slicer* slicer;
  bench::check(msq_slicer_create(model, &def, &slicer));
  msq_model_release(model);
  bench::Reader reader;
  const double seconds = bench::median_seconds([&] {
    bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  msq_slicer_release(slicer);
  return seconds;
}

void measure(bench::Report& report, msq_context* context, const std::string& name, msq_shape* shape,
             uint32_t resolution) {
  const double rows = double(resolution) * resolution;
  report.add(name + ": no skin", slice(context, shape, {0, nullptr}, resolution), rows, "row");
  for (double thickness : {0.002, 0.01, 0.03, 0.1})
    report.add(name + ": skin " + std::to_string(thickness),
               slice(context, shape, {thickness, nullptr}, resolution), rows, "row");
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 1};
  msq_field* field;
  bench::check(msq_field_gradient(context, from, 0.05, to, 0.01, &field));
  report.add(name + ": skin 0.05 to 0.01", slice(context, shape, {0, field}, resolution), rows,
             "row");
  msq_field_release(field);
  msq_shape_release(shape);
}

}  // namespace

int main(int count, char** arguments) try {
  const uint32_t resolution = 1024;
  bench::Report report("slices at " + std::to_string(resolution) + "^3 with a skin");
  msq_context* context = bench::make_context();
  measure(report, context, "mesh of 270,400 triangles",
          bench::make_shape(context, bench::rippled_torus(520, 260)), resolution);
  const double low[3] = {0.01, 0.02, 0.03}, high[3] = {0.99, 0.97, 0.98};
  msq_shape* shape;
  bench::check(msq_shape_from_box(context, low, high, &shape));
  measure(report, context, "box", shape, resolution);
  bench::check(msq_shape_from_cylinder(context, low, high, 0.3, &shape));
  measure(report, context, "cylinder", shape, resolution);
  msq_context_release(context);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
