// SPDX-License-Identifier: Apache-2.0
// Functional structures in the unit cube, layers as bits.
//
// usage: functional [results.json] [largest slices, default 2048]
#include <cstdlib>
#include <optional>
#include <string>

#include "setup.h"

namespace {

constexpr const char* gyroid = "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)";
/// No sum of products: comparisons, a root and an exponential.
constexpr const char* blend =
    "min(sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x), sqrt(4+cos(x)+cos(y)*cos(z))-2)"
    "+0.1*exp(sin(x)*sin(y)*sin(z))";

struct Setting {
  int cells = 32;
  const char* expression = nullptr;  // NULL: the gyroid of the library
  bool is_graded = false, is_turned = false;
  int32_t period_axis = -1;  // cells along it from half to twice the size; -1: of one size
  int32_t warp = 0;          // an msq_warp_kind about the middle of the cube; 0: none
  double shear = 0;          // along the axis
  uint32_t clusters = 0;
  int32_t kind = MSQ_FUNCTIONAL_NETWORK;
  double level = 0;
};

/// Seconds for the first `layers` of resolution^3 samples, on two threads.
double slice_seconds(const Setting& setting, uint32_t resolution, uint64_t layers) {
  msq_context* context = bench::make_context();
  msq_functional_def def;
  bench::check(msq_functional_def_init(&def, sizeof def));
  if (setting.expression) {
    def.function = MSQ_FUNCTION_EXPRESSION;
    def.expression = setting.expression;
  }
  def.kind = setting.kind;
  def.clusters = setting.clusters;
  def.level.value = setting.level;
  for (double& size : def.grid.cell_size) size = 1.0 / setting.cells;
  if (setting.is_turned) bench::turn(def.grid);
  const double positions[] = {0, 1}, sizes[] = {0.5 / setting.cells, 2.0 / setting.cells};
  msq_period_def period;
  bench::check(msq_period_def_init(&period, sizeof period));
  period.axis = setting.period_axis;
  period.positions = positions;
  period.cell_sizes = sizes;
  period.count = 2;
  if (setting.period_axis >= 0) def.period = &period;
  msq_warp_def warp = bench::warp_of(setting.warp, setting.cells);
  warp.shear_along = setting.shear;
  std::optional<bench::SampledCells> map;
  if (setting.warp == MSQ_WARP_SAMPLED) map.emplace(context, setting.cells).set(warp);
  if (setting.warp) {
    bench::put_in_middle(def.grid);
    def.warp = &warp;
  }
  msq_field* field = nullptr;
  if (setting.is_graded) {
    const double from[3] = {0, 0, 0}, to[3] = {1, 0.5, 0.25};
    bench::check(msq_field_gradient(context, from, -0.8, to, 0.8, &field));
    def.level.field = field;
  }
  msq_structure* structure;
  bench::check(msq_structure_functional(context, &def, &structure));
  msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution));
  bench::Reader reader;
  const double seconds = bench::median_seconds([&] {
    bench::check(msq_slicer_run(slicer, 0, layers, bench::Reader::take, &reader, nullptr));
  });
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_field_release(field);
  msq_context_release(context);
  return seconds;
}

}  // namespace

int main(int count, char** arguments) try {
  const uint32_t largest = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  bench::Report report("Functional structures, two threads");
  const auto add = [&](const std::string& name, const Setting& setting, uint32_t resolution,
                       uint64_t layers = UINT64_MAX) {
    if (resolution > largest) return 0.0;
    const double seconds = slice_seconds(setting, resolution, layers);
    const double samples = double(resolution) * resolution *
                           (layers == UINT64_MAX ? double(resolution) : double(layers));
    report.add(name + ", " + std::to_string(resolution) + "^3" +
                   (layers == UINT64_MAX ? "" : ", " + std::to_string(layers) + " layers"),
               seconds, samples, "sample");
    return seconds;
  };
  Setting setting;
  add("gyroid, 32^3 cells", setting, 2048);
  setting.cells = 256;
  add("gyroid, 256^3 cells", setting, 2048);
  setting.cells = 37;
  const double plain =
      add("gyroid, 37^3 cells, which no whole number of samples fills", setting, 2048);
  for (const int axis : {0, 2}) {
    setting.period_axis = axis;
    const char* const name = axis ? "gyroid, 37^3 cells, period graded along z"
                                  : "gyroid, 37^3 cells, period graded along x";
    const double graded = add(name, setting, 2048);
    if (plain > 0) report.note("against the plain one", graded / plain, "times");
  }
  setting.period_axis = -1;
  setting.cells = 32;
  setting.is_graded = true;
  add("gyroid, 32^3 cells, graded level", setting, 2048);
  setting.is_graded = false;
  setting.is_turned = true;
  add("gyroid, 32^3 cells, turned grid", setting, 2048, 256);
  setting.is_turned = false;
  setting.warp = MSQ_WARP_CYLINDRICAL;
  add("gyroid, 32 cells across, around an axis", setting, 2048);
  setting.shear = 0.5;
  add("gyroid, 32 cells across, around an axis, twisted", setting, 2048);
  setting.shear = 0;
  setting.warp = MSQ_WARP_SPHERICAL;
  add("gyroid, 32 cells across, around a point", setting, 2048, 64);
  setting.warp = MSQ_WARP_SAMPLED;
  add("gyroid, 32 cells across, by a map of 65^3 samples", setting, 2048);
  setting.warp = 0;
  setting.expression = gyroid;
  add("gyroid as an expression, 32^3 cells", setting, 1024);
  setting.expression = nullptr;
  setting.cells = 9;
  const double gyroid_with = add("gyroid, 9^3 cells", setting, 1024, 128);
  setting.clusters = 1;
  const double gyroid_without = add("the same without clusters", setting, 1024, 128);
  if (gyroid_with > 0)
    report.note("gyroid: without clusters against with", gyroid_without / gyroid_with, "times");
  setting.clusters = 0;
  setting.expression = blend;
  setting.cells = 9;
  setting.level = 0.1;
  const double with = add("expression with choices, 9^3 cells", setting, 1024, 128);
  setting.clusters = 1;
  const double without = add("the same without clusters", setting, 1024, 128);
  if (with > 0) report.note("expression: without clusters against with", without / with, "times");
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
