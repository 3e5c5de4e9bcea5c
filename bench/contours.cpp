// SPDX-License-Identifier: Apache-2.0
// Contours of a layer of 2048^2 nodes, one thread, beside the bits of the same layer, and beside
// crossings found by bisection, which is what fields of radii and other structures than struts
// take.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "setup.h"

namespace {

struct Setup {
  const char* kind;
  int cells;
  double radius;  // in cells
};

/// By struts, or by bisection: then the radius is a field.
msq_structure* make_structure(msq_context* context, const Setup& setup, bool by_struts) {
  msq_structure* structure = nullptr;
  msq_field* field = nullptr;
  if (!by_struts) {
    const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    bench::check(
        msq_field_gradient(context, low, setup.radius, high, setup.radius * (1 + 1e-6), &field));
  }
  if (setup.kind[0] == 'f') {
    msq_foam_def def;
    bench::check(msq_foam_def_init(&def, sizeof def));
    def.radius = {setup.radius, field};
    if (field) def.radius.value = 0;
    bench::check(msq_structure_foam(context, &def, &structure));
  } else if (setup.kind[0] == 'l') {
    msq_lattice_def def;
    bench::check(msq_lattice_def_init(&def, sizeof def));
    def.radius = {setup.radius, field};
    if (field) def.radius.value = 0;
    bench::check(msq_structure_lattice(context, &def, &structure));
  } else {
    msq_functional_def def;
    bench::check(msq_functional_def_init(&def, sizeof def));
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.level.value = setup.radius;
    bench::check(msq_structure_functional(context, &def, &structure));
  }
  msq_field_release(field);
  return structure;
}

void measure(bench::Report& report, const Setup& setup, uint32_t resolution) {
  const double extent = setup.cells, pitch = extent / resolution, height = 3.37;
  const std::string name =
      std::string(setup.kind) + ", " + std::to_string(setup.cells) + "^2 cells";
  for (const bool by_struts : {true, false}) {
    if (!by_struts && setup.kind[0] == 'g') continue;
    msq_context* context = bench::make_context(1);
    const double low[3] = {0, 0, 0}, high[3] = {extent, extent, 8};
    msq_shape* shape;
    bench::check(msq_shape_from_box(context, low, high, &shape));
    msq_model* model = bench::make_model(context, shape, make_structure(context, setup, by_struts));
    if (by_struts) {
      msq_slicer_def def;
      bench::check(msq_slicer_def_init(&def, sizeof def));
      def.resolution[0] = def.resolution[1] = resolution;
      def.layer_z = &height;
      def.layer_z_count = 1;
      msq_slicer* slicer;
      bench::check(msq_slicer_create(model, &def, &slicer));
      std::vector<uint8_t> bits(size_t{resolution} * (resolution / 8 + 8));
      const double seconds = bench::median_seconds(
          [&] { bench::check(msq_slice_layer(slicer, 0, bits.data(), bits.size(), nullptr)); });
      report.add(name + ": bits", seconds, double(resolution) * resolution, "sample");
      msq_slicer_release(slicer);
    }
    struct Way {
      double tolerance;
      uint32_t topology_samples;
    };
    for (const auto [tolerance, samples] :
         {Way{0.5, 0}, Way{0.25, 0}, Way{0.1, 0}, Way{0.5, 4}, Way{0.5, 16}}) {
      if (!by_struts && (tolerance != 0.5 || samples != 0)) continue;
      msq_contours_def def;
      bench::check(msq_contours_def_init(&def, sizeof def));
      def.type = MSQ_INT64;
      def.units = 1e6;
      def.pitch = pitch;
      def.tolerance = tolerance * pitch;
      def.topology_samples = samples;
      msq_contours_report made{};
      const double seconds = bench::median_seconds([&] {
        msq_contours* contours;
        bench::check(msq_layer_contours(model, height, &def, &contours, nullptr));
        made.struct_size = sizeof made;
        bench::check(msq_contours_info(contours, &made));
        msq_contours_release(contours);
      });
      char text[120];
      std::snprintf(text, sizeof text, ": %s, %.2f px, %llu rings, ",
                    by_struts ? "contours" : "by bisection", tolerance,
                    static_cast<unsigned long long>(made.ring_count));
      const std::string counted = samples ? "topology " + std::to_string(made.topology_count) +
                                                " by " + std::to_string(samples)
                                          : std::to_string(made.unresolved_count) + " unresolved";
      report.add(name + text + counted, seconds, double(made.point_count), "point");
    }
    msq_model_release(model);
    msq_context_release(context);
  }
}

}  // namespace

int main(int count, char** arguments) try {
  const uint32_t resolution = 2048;
  bench::Report report("contours of a layer of 2048^2 nodes, one thread");
  for (const Setup& setup :
       {Setup{"foam", 128, 0.1}, Setup{"foam", 32, 0.1}, Setup{"foam", 32, 0.25},
        Setup{"lattice", 128, 0.1}, Setup{"gyroid", 32, 0.3}})
    measure(report, setup, resolution);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
