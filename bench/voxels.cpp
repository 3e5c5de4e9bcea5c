// SPDX-License-Identifier: Apache-2.0
// A voxel image of 512^3 bytes as the coarse shape, alone: a porous ball, layers as bits.
//
// usage: voxels [results.json] [resolution, default 1024]
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "setup.h"

namespace {

constexpr uint64_t side = 512;

/// 0 to 255, the surface at 128: a ball with pores of about 20 voxels.
std::vector<uint8_t> make_values() {
  std::vector<uint8_t> values(side * side * side);
  std::vector<double> wave(side);
  for (uint64_t i = 0; i < side; ++i) wave[i] = std::sin(0.16 * double(i));
  uint8_t* v = values.data();
  for (uint64_t k = 0; k < side; ++k)
    for (uint64_t j = 0; j < side; ++j)
      for (uint64_t i = 0; i < side; ++i) {
        const double x = double(i) - 255.5, y = double(j) - 255.5, z = double(k) - 255.5;
        const double ball = 240 - std::sqrt(x * x + y * y + z * z);
        const double pores = 8 * (0.6 - wave[i] * wave[j] * wave[(j + k) % side] - wave[k]);
        *v++ = static_cast<uint8_t>(std::clamp(128 + 40 * std::min(ball, pores), 0.0, 255.0));
      }
  return values;
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("A voxel image of 512^3 bytes, two threads");
  const uint32_t resolution = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 1024;
  const std::vector<uint8_t> values = make_values();
  for (bool is_turned : {false, true}) {
    msq_context* context = bench::make_context();
    msq_voxels_def def;
    bench::check(msq_voxels_def_init(&def, sizeof def));
    def.threshold = 128;
    def.image.values = values.data();
    def.image.value_type = MSQ_UINT8;
    for (uint64_t& size : def.image.size) size = side;
    if (is_turned) {
      const double c = std::cos(0.3), s = std::sin(0.3);
      const double turn[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
      for (int i = 0; i < 9; ++i) def.image.grid.rotation[i] = turn[i];
    }
    msq_shape* shape = nullptr;
    const double made = bench::median_seconds([&] {
      msq_shape_release(shape);
      bench::check(msq_shape_from_voxels(context, &def, &shape));
    });
    const std::string name = is_turned ? ", turned" : "";
    report.add("made" + name, made, double(values.size()), "voxel");
    msq_memory_report memory{};
    memory.struct_size = sizeof memory;
    bench::check(msq_context_memory(context, &memory));
    report.note("  memory a voxel", double(memory.bytes) / double(values.size()), "bytes");

    msq_model* model = bench::make_model(context, shape, nullptr);
    msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution, side));
    bench::Reader reader;
    const double sliced = bench::median_seconds([&] {
      bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
    });
    report.add(std::to_string(resolution) + "^3 sliced" + name, sliced,
               std::pow(double(resolution), 3), "sample");

    constexpr uint64_t points = 10000;
    uint64_t state = 1;
    double sum = 0;
    const double asked = bench::median_seconds(
        [&] {
          for (uint64_t n = 0; n < points; ++n) {
            double point[3], distance;
            for (double& x : point) {
              state = state * 6364136223846793005u + 1442695040888963407u;
              x = double(state >> 40) * 0x1p-24 * side;
            }
            bench::check(msq_point_distance(model, point, nullptr, &distance));
            sum += distance;
          }
        },
        1);
    report.add("distances at random points" + name, asked, double(points), "point");
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
    if (!std::isfinite(sum)) return 1;
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
