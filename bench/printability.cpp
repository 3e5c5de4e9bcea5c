// SPDX-License-Identifier: Apache-2.0
// Islands, loose parts and voids of a stack of layers, beside the bits of the same layers. Thin
// places in addition. One thread, and all threads.
#include <cstdio>
#include <string>

#include "setup.h"

namespace {

constexpr uint32_t resolution = 1024;
constexpr uint32_t cell_pixels = 16;  // pixels and layers to a cell
constexpr double target = 2;

msq_structure* make_structure(msq_context* context, const std::string& kind) {
  msq_structure* structure = nullptr;
  if (kind == "foam of struts" || kind == "foam of walls") {
    msq_foam_def def;
    bench::check(msq_foam_def_init(&def, sizeof def));
    (kind == "foam of walls" ? def.wall_thickness : def.radius).value = 0.12;
    bench::check(msq_structure_foam(context, &def, &structure));
  } else if (kind == "lattice" || kind == "turned lattice") {
    msq_lattice_def def;
    bench::check(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell = MSQ_UNIT_CELL_OCTET;
    def.radius.value = 0.08;
    if (kind == "turned lattice") bench::turn(def.grid);
    bench::check(msq_structure_lattice(context, &def, &structure));
  } else if (kind == "gyroid") {
    msq_functional_def def;
    bench::check(msq_functional_def_init(&def, sizeof def));
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.thickness.value = 0.15;
    bench::check(msq_structure_functional(context, &def, &structure));
  }
  return structure;
}

/// A ball filled with the structure.
void measure(bench::Report& report, const std::string& kind, uint32_t threads) {
  msq_context* context = bench::make_context(threads);
  const double size = double(resolution) / cell_pixels;
  const double center[3] = {size / 2, size / 2, size / 2};
  msq_shape* ball;
  bench::check(msq_shape_from_sphere(context, center, size / 2, &ball));
  msq_model* model = bench::make_model(context, ball, make_structure(context, kind));
  msq_slicer_def plan;
  bench::check(msq_slicer_def_init(&plan, sizeof plan));
  plan.resolution[0] = plan.resolution[1] = resolution;
  plan.layer_height = 1.0 / cell_pixels;
  plan.window.first[2] = resolution / 2;  // from the middle on
  plan.window.count[0] = plan.window.count[1] = resolution;
  plan.window.count[2] = 128;
  msq_slicer* slicer;
  bench::check(msq_slicer_create(model, &plan, &slicer));
  const std::string name = kind + ", " + std::to_string(threads) + " threads";
  const double samples = double(resolution) * resolution * double(plan.window.count[2]);

  bench::Reader reader;
  const double bits = bench::median_seconds([&] {
    bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  });
  report.add(name + ": bits", bits, samples, "sample");
  for (const bool with_thin : {false, true}) {
    msq_printability_def def;
    bench::check(msq_printability_def_init(&def, sizeof def));
    if (with_thin) {
      def.kinds |= MSQ_FINDING_THIN;
      def.width = 3.0 / cell_pixels;
    }
    msq_printability_report found{};
    found.struct_size = sizeof found;
    const double seconds = bench::median_seconds(
        [&] { bench::check(msq_printability(slicer, &def, nullptr, nullptr, &found, nullptr)); });
    char text[160];
    std::snprintf(text, sizeof text, ": %llu islands, %llu loose, %llu voids, %llu thin",
                  static_cast<unsigned long long>(found.island_count),
                  static_cast<unsigned long long>(found.loose_count),
                  static_cast<unsigned long long>(found.void_count),
                  static_cast<unsigned long long>(found.thin_count));
    report.add(name + text, seconds, samples, "sample");
    if (with_thin)
      report.note(name + ", with thin places, times the bits", seconds / bits, "");
    else
      report.mark(name + ", times the bits", seconds / bits, "", target, false);
  }
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("printability of 128 layers of 1024^2 pixels");
  const std::string only = count > 2 ? arguments[2] : "";  // "turned lattice, 1": this case alone
  for (const uint32_t threads : {1u, 2u})
    for (const char* kind :
         {"foam of struts", "foam of walls", "lattice", "turned lattice", "gyroid", "solid"})
      if (only.empty() || only == std::string(kind) + ", " + std::to_string(threads))
        measure(report, kind, threads);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
