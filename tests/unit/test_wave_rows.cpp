// SPDX-License-Identifier: Apache-2.0
// What rows of sums of waves are made of: interpolation between knots within its bound, blocks of
// many layers, grids whose words reach far beyond them, and samples without the definition.
#include <cmath>

#include "base/infinity.h"
#include "base/pi.h"
#include "bit_rows.h"
#include "field/field.h"
#include "random.h"
#include "structure/waves/knots.h"
#include "structure/waves/wave_set.h"
#include "structure/waves/waves.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

WaveDirections directions(uint32_t count, Vec3 half_angles = {pi / 2, 0, 0}) {
  WaveDirections made;
  made.seed = 17;
  made.count = count;
  made.half_angles = half_angles;
  return made;
}

/// The waves along an axis, with phases.
struct Line {
  std::vector<double> rates, phases;
  double amplitude;

  double at(double x) const {
    double sum = 0;
    for (size_t i = 0; i < rates.size(); ++i) sum += std::cos(two_pi * (rates[i] * x + phases[i]));
    return amplitude * sum;
  }
};

Line random_line(Random& random, size_t count, double fastest) {
  Line line{{}, {}, std::sqrt(2.0 / static_cast<double>(count))};
  for (size_t i = 0; i < count; ++i) {
    line.rates.push_back(fastest * (2 * random.unit() - 1));
    line.phases.push_back(random.unit());
  }
  return line;
}

/// What rounding may add.
constexpr double roundings = 1e-10;

void samples_are_within_the_error_of_knots(void**) {
  Random random(3);
  bool were_samples = false, were_few = false;
  for (size_t n = test_count(300) + 20; n > 0; --n) {
    const size_t count = 1 + random.below(max_knots);
    const double pitch = std::exp2(-8 + 8 * random.unit());
    const Line line = random_line(random, 1 + random.below(40), n % 8 ? 1 : 0);
    std::vector<double> even_steps, steps;
    for (size_t i = 0; i < count; ++i) {
      even_steps.push_back(3 + pitch * static_cast<double>(i));
      steps.push_back((i ? steps.back() : -2) + pitch * (0.1 + random.unit()));
    }
    const AxisWaves waves{line.rates.data(), line.rates.size(), line.amplitude};
    const Knots free = knots_for(waves, steps.data(), count);
    const size_t m = free.count();
    assert_true(free.are_samples ? m == count : m < count);
    for (size_t s = 0; s < count; ++s) {
      double sum = 0, magnitudes = 0;
      for (size_t j = 0; j < m; ++j) {
        sum += free.weights[s * m + j] * line.at(free.centre + free.offsets[j]);
        magnitudes += std::abs(free.weights[s * m + j]);
      }
      assert_true(std::abs(sum - line.at(steps[s])) <= free.error + roundings);
      assert_true(magnitudes <= free.constant);
    }
    const Knots pairs = knot_pairs_for(waves, even_steps.data(), count);
    const size_t k = pairs.count();
    assert_true(pairs.are_samples ? k == (count + 1) / 2 : 2 * k < count);
    for (size_t p = 0; p < (count + 1) / 2; ++p) {
      double even = 0, odd = 0, magnitudes = 0;
      for (size_t j = 0; j < k; ++j) {
        const double* const weights = pairs.weights.data() + p * 2 * k + j;
        const double above = line.at(pairs.centre + pairs.offsets[j]);
        const double below = line.at(pairs.centre - pairs.offsets[j]);
        even += weights[0] * 0.5 * (above + below);
        odd += weights[k] * 0.5 * (above - below);
        magnitudes += std::abs(weights[0]) + std::abs(weights[k]);
      }
      const double upper = line.at(even_steps[count / 2 + p]);
      const double lower = line.at(even_steps[(count - 1) / 2 - p]);
      assert_true(std::abs(even + odd - upper) <= pairs.error + roundings);
      assert_true(std::abs(even - odd - lower) <= pairs.error + roundings);
      assert_true(magnitudes <= pairs.spread);
    }
    were_samples = were_samples || pairs.are_samples;
    were_few = were_few || (count > 30 && k < 10);
  }
  assert_true(were_samples && were_few);
}

/// Fills all samples and compares some of them.
void check_block(const Waves& solid, const SampleGrid& grid, Random& random, size_t samples) {
  BitRows rows(grid);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j) set_bits(rows.block().row(j, k), 0, grid.nx - 1);
  solid.keep_rows(rows.block(), nullptr);
  for (; samples > 0; --samples) {
    const uint64_t i = random.below(grid.nx), j = random.below(grid.ny), k = random.below(grid.nz);
    const bool is_inside = solid.inside(grid.at(i, j, k));
    if (rows.get(i, j, k) != is_inside)
      fail_msg("sample %d %d %d is %d", int(i), int(j), int(k), rows.get(i, j, k));
  }
}

void deep_blocks_are_the_definition(void**) {
  Random random(5);
  for (const double pitch : {1.0 / 300, 1.0 / 64, 1.0 / 30, 1.0 / 8})
    for (const WavesKind kind : {WavesKind::network, WavesKind::sheet}) {
      const Waves solid(Neighbourhood{{1, 2, 3}, {1, 1.25, 0.75}, {}}, directions(150), kind,
                        Parameter(0.5));
      SampleGrid grid;
      grid.origin = random.in_box({{-9, -9, -9}, {9, 9, 9}});
      grid.spacing = {pitch, pitch, 1.5 * pitch};
      grid.nx = 70 + random.below(60);
      grid.ny = 33 + random.below(64);
      grid.nz = 33 + random.below(64);
      check_block(solid, grid, random, test_count(4000) + 100);
    }
}

/// A level that a sample has just reached, and the number below it.
void samples_at_the_level_are_exact(void**) {
  Random random(9);
  const Neighbourhood cells{{1, 2, 3}, {1, 1.25, 0.75}, {}};
  for (size_t n = test_count(300) + 30; n > 0; --n) {
    const double pitch = std::exp2(-8 + 4 * random.unit());
    SampleGrid grid;
    grid.origin = random.in_box({{-9, -9, -9}, {9, 9, 9}});
    grid.spacing = {pitch, pitch, pitch};
    grid.nx = grid.ny = grid.nz = 64;
    const uint64_t i = random.below(64), j = random.below(64), k = random.below(64);
    const WavesKind kind = n % 2 ? WavesKind::network : WavesKind::sheet;
    const Vec3 p = grid.at(i, j, k);
    const double reached = Waves(cells, directions(60), kind, Parameter(0)).onset(p);
    for (const bool is_inside : {true, false}) {
      const double level = is_inside ? reached : std::nextafter(reached, -infinity);
      const Waves solid(cells, directions(60), kind, Parameter(level));
      BitRows rows(grid);
      rows.set(i, j, k);
      solid.keep_rows(rows.block(), nullptr);
      assert_true(rows.get(i, j, k) == is_inside);
    }
  }
}

/// Waves along one axis alone do not vary along the others.
void layers_are_the_definition(void**) {
  Random random(6);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 cones{0, 0, 0};
    cones[axis] = 0.01;
    WaveDirections flat = directions(20, cones);
    flat.tile[0] = flat.tile[1] = flat.tile[2] = 2;
    const Waves solid(Neighbourhood{}, flat, WavesKind::network, Parameter(-0.25));
    for (size_t i = 0; i < 20; ++i) assert_true(solid.waves().wave(i)[(axis + 1) % 3] == 0);
    SampleGrid grid;
    grid.origin = {0.2, 0.3, 0.4};
    grid.spacing = {0.01, 0.02, 0.03};
    grid.nx = 100;
    grid.ny = 50;
    grid.nz = 40;
    check_block(solid, grid, random, test_count(4000) + 100);
  }
}

/// A word has 64 samples, of which the grid has one; the middle of the word is far away.
void words_may_reach_far_beyond_the_grid(void**) {
  Random random(7);
  for (const double far : {1e3, 1e7, 1e12, 1e300}) {
    const Waves solid(Neighbourhood{}, directions(30), WavesKind::network, Parameter(0));
    SampleGrid grid;
    grid.spacing = {far, 0.07, 0.05};
    grid.nx = 1;
    grid.ny = 40;
    grid.nz = 20;
    check_block(solid, grid, random, test_count(2000) + 800);
  }
}

/// A constant that counts how often it is evaluated.
class CountedField final : public Field {
 public:
  explicit CountedField(double value) : value_(value) {}
  double at(Vec3) const override {
    ++count;
    return value_;
  }
  Interval range() const override { return {value_, value_}; }
  Interval range(const Box3&) const override { return {value_, value_}; }
  mutable size_t count = 0;

 private:
  void describe(HashInput&) const override {}
  double value_;
};

void most_samples_need_no_definition(void**) {
  const Ref<CountedField> field = make_ref<CountedField>(0.3);
  const Waves solid(Neighbourhood{}, directions(100), WavesKind::network, Parameter(field));
  SampleGrid grid;
  grid.spacing = {1.0 / 64, 1.0 / 64, 1.0 / 64};
  grid.nx = grid.ny = grid.nz = 64;
  Random random(8);
  check_block(solid, grid, random, 0);
  // A sample in 2 / 1e-4 is that near the level.
  assert_in_range(field->count, 0, 64 * 64 * 64 / 1000);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(samples_are_within_the_error_of_knots),
      cmocka_unit_test(deep_blocks_are_the_definition),
      cmocka_unit_test(samples_at_the_level_are_exact),
      cmocka_unit_test(layers_are_the_definition),
      cmocka_unit_test(words_may_reach_far_beyond_the_grid),
      cmocka_unit_test(most_samples_need_no_definition),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
