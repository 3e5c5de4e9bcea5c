// SPDX-License-Identifier: Apache-2.0
// The waves of rows through sampled maps, against the C library: the error is below its bound.
#include <algorithm>
#include <cmath>
#include <vector>

#include "structure/functional/map_kernels.h"
#include "suite.h"

using namespace msq;

namespace {

constexpr size_t words = 512, samples = 64 * words;

/// The largest error of sines and cosines of `frequency` times the turns from `start` on, over one
/// voxel that all samples are in.
double largest_error(float start, float rise, float frequency) {
  std::vector<uint32_t> voxels(samples), numbers(words);
  std::vector<float> fractions(samples), sines(samples), cosines(samples);
  for (size_t i = 0; i < samples; ++i)
    fractions[i] = static_cast<float>(i) / static_cast<float>(samples);
  for (uint32_t w = 0; w < words; ++w) numbers[w] = w;
  std::vector<float> starts(1 + map_padding, start), rises(1 + map_padding, rise);
  const MapWave wave{1, frequency, sines.data(), cosines.data()};
  find_map_waves({voxels.data(),
                  fractions.data(),
                  {nullptr, starts.data(), nullptr},
                  {nullptr, rises.data(), nullptr}},
                 numbers.data(), words, &wave, 1);
  double most = 0;
  for (size_t i = 0; i < samples; ++i) {
    const double turns = frequency * (double{start} + double{fractions[i]} * rise),
                 angle = 8 * std::atan(1.0) * (turns - std::round(turns));
    most = std::max({most, std::abs(double{sines[i]} - std::sin(angle)),
                     std::abs(double{cosines[i]} - std::cos(angle))});
  }
  return most;
}

void waves_are_within_their_error(void**) {
  // The turns are exact: parts of 2^-15.
  assert_true(largest_error(0, 1, 1) < map_wave_error);
  assert_true(largest_error(1, -1, 1) < map_wave_error);
  assert_true(largest_error(0.25f, 0.5f, 2) < map_wave_error);
  assert_true(largest_error(0.5f, 0.5f, -3) < map_wave_error);
}

/// The nodes of a voxel are those at its own ends.
void samples_find_their_voxels(void**) {
  constexpr size_t nodes = 41;
  std::vector<double> low(nodes + map_padding), high(nodes + map_padding);
  for (size_t i = 0; i < nodes; ++i) {
    low[i] = 0.21 * static_cast<double>(i * i % 17);
    high[i] = low[i] + 1;
  }
  std::vector<float> starts(nodes + map_padding), rises(nodes + map_padding);
  blend_nodes(low.data(), high.data(), 0.25, nodes - 1, starts.data(), rises.data());
  for (const bool is_falling : {false, true}) {
    std::vector<uint32_t> voxels(64), numbers{0};
    std::vector<float> fractions(64), sines(64), cosines(64);
    for (uint32_t i = 0; i < 64; ++i) {
      voxels[i] = is_falling ? 39 - 39 * i / 63 : 39 * i / 63;
      fractions[i] = static_cast<float>(i % 7) / 8;
    }
    const MapWave wave{2, 1, sines.data(), cosines.data()};
    find_map_waves({voxels.data(),
                    fractions.data(),
                    {nullptr, nullptr, starts.data()},
                    {nullptr, nullptr, rises.data()}},
                   numbers.data(), 1, &wave, 1);
    for (size_t i = 0; i < 64; ++i) {
      const double a = low[voxels[i]] + 0.25, b = low[voxels[i] + 1] + 0.25;
      const double angle = 8 * std::atan(1.0) * (a + double{fractions[i]} * (b - a));
      assert_true(std::abs(double{sines[i]} - std::sin(angle)) < 1e-4);
      assert_true(std::abs(double{cosines[i]} - std::cos(angle)) < 1e-4);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(waves_are_within_their_error),
      cmocka_unit_test(samples_find_their_voxels),
  };
  return cmocka_run_group_tests_name("map_waves", tests, nullptr, nullptr);
}
