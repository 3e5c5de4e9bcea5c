// SPDX-License-Identifier: Apache-2.0
// Sums of waves in the unit cube, layers as bits; also in processor time, which neighbours on the
// machine change less.
//
// usage: waves [results.json] [samples along a side, default 2048] [part of the names of the works]
#include <cstdlib>
#include <string>

#include "setup.h"

namespace {

struct Setting {
  uint32_t count = 400;
  double wavelengths = 32;  // along a side
  bool is_graded = false, is_turned = false;
  int32_t kind = MSQ_FUNCTIONAL_NETWORK;
};

struct Seconds {
  double wall, processor;
};

/// For the first `layers` of resolution^3 samples, on two threads.
Seconds slice_seconds(const Setting& setting, uint32_t resolution, uint64_t layers) {
  msq_context* context = bench::make_context();
  msq_waves_def def;
  bench::check(msq_waves_def_init(&def, sizeof def));
  def.kind = setting.kind;
  def.count = setting.count;
  for (double& size : def.grid.cell_size) size = 1 / setting.wavelengths;
  if (setting.is_turned) bench::turn(def.grid);
  msq_field* field = nullptr;
  if (setting.is_graded) {
    const double from[3] = {0, 0, 0}, to[3] = {1, 0.5, 0.25};
    bench::check(msq_field_gradient(context, from, -0.8, to, 0.8, &field));
    def.level.field = field;
  } else {
    def.volume_fraction = 0.3;
  }
  msq_structure* structure;
  bench::check(msq_structure_waves(context, &def, &structure));
  msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution));
  bench::Reader reader;
  const auto run = [&] {
    bench::check(msq_slicer_run(slicer, 0, layers, bench::Reader::take, &reader, nullptr));
  };
  const Seconds seconds{bench::median_seconds(run), bench::min_processor_seconds(run)};
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_field_release(field);
  msq_context_release(context);
  return seconds;
}

}  // namespace

int main(int count, char** arguments) try {
  const uint32_t resolution = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  const std::string part = count > 3 ? arguments[3] : "";
  bench::Report report("Sums of waves, two threads");
  const auto add = [&](const std::string& name, const Setting& setting,
                       uint64_t layers = UINT64_MAX) {
    if (name.find(part) == std::string::npos) return;
    const double deep = layers == UINT64_MAX ? double(resolution) : double(layers);
    const double samples = double(resolution) * resolution * deep;
    const Seconds seconds = slice_seconds(setting, resolution, layers);
    report.add(name, seconds.wall, samples, "sample");
    report.add(name + ", processor", seconds.processor, samples, "sample");
  };
  Setting setting;
  add("400 waves, 32 wavelengths", setting);
  setting.count = 60;
  add("60 waves", setting);
  setting.count = 400;
  setting.kind = MSQ_FUNCTIONAL_SHEET;
  add("400 waves, sheet", setting);
  setting.kind = MSQ_FUNCTIONAL_NETWORK;
  setting.is_turned = true;
  add("400 waves, turned grid", setting);
  setting.is_turned = false;
  setting.is_graded = true;
  add("400 waves, graded level", setting);
  setting.is_graded = false;
  setting.wavelengths = 128;
  add("400 waves, 128 wavelengths, 256 layers", setting, 256);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
