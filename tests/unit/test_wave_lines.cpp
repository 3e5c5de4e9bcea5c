// SPDX-License-Identifier: Apache-2.0
// Lines of sums of waves, whose signs at nodes come from rows of bits: they have the same bits as
// those of the sum at each node.
#include <cmath>
#include <cstring>

#include "base/pi.h"
#include "msq_test.h"
#include "random.h"
#include "structure/common/level_lines.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/waves.h"

using namespace msq;
using namespace msq::test;

namespace {

/// The sum at each node.
class Sums final : public LevelFunction {
 public:
  explicit Sums(const Waves& waves) : waves_(waves) {}

  double at(Vec3 p) const override {
    const double g = wave_sum(waves_.waves(), waves_.position(p));
    return waves_.is_sheet() ? g : g - waves_.level().at(p);
  }
  void row(const double* x, double y, double z, size_t count, double* to) override {
    for (size_t i = 0; i < count; ++i) to[i] = at({x[i], y, z});
  }

 private:
  const Waves& waves_;
};

size_t compare(const Waves& waves, const WallSection& section) {
  const LineGraph found = waves.wall_lines(section);
  Sums sums(waves);
  const LineGraph expected = LevelLines(sums, min_component(waves.neighbourhood().cell_size) / 16,
                                        !waves.is_sheet(), section)
                                 .find();
  assert_int_equal(found.points.size(), expected.points.size());
  assert_int_equal(found.lines.size(), expected.lines.size());
  if (found.lines.empty()) return 0;
  assert_memory_equal(found.points.data(), expected.points.data(),
                      found.points.size() * sizeof(Vec2));
  assert_memory_equal(found.lines.data(), expected.lines.data(),
                      found.lines.size() * sizeof found.lines[0]);
  return found.lines.size();
}

void lines_are_those_of_sums(void**) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const Neighbourhood grids[] = {
      {{0, 0, 0}, {1, 1, 1}, {}},
      {{0.3, -0.7, 5}, {2, 1, 3}, {{c, 0, s, 0, 1, 0, -s, 0, c}}},
      {{1e5, -1e5, 0}, {1, 1.5, 1}, {{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}}},
      {{0, 0, 0}, {1e-6, 1e-6, 1e-6}, {}}};
  Random random(11);
  size_t lines = 0, kinds = 0;
  for (const Neighbourhood& grid : grids)
    for (const WavesKind kind : {WavesKind::network, WavesKind::sheet})
      for (const uint32_t count : {1u, 7u, 100u})
        for (const double level : {0.0, 0.6, -1.1}) {
          if (kind == WavesKind::sheet && level <= 0) continue;
          WaveDirections directions{kinds, count, {0.5 * pi, 0, 0}, {}};
          // Waves that repeat after few cells have the same values at many nodes.
          if (count == 7) directions.tile[0] = directions.tile[1] = directions.tile[2] = 2;
          const auto waves = make_ref<const Waves>(grid, directions, kind, Parameter(level));
          const double size = min_component(grid.cell_size);
          const Vec3 at = grid.origin + random.in_box({{-3, -3, -3}, {3, 3, 3}}) * size;
          const Vec2 low{at.x, at.y}, extent{(3 + 2 * random.below(3)) * size, 5.3 * size};
          lines += compare(*waves, {at.z, {low, low + extent}, 5e-3 * size});
          // Nodes of the grid at whole numbers, and one square.
          compare(*waves, {grid.origin.z, {{0, 0}, {0.01 * size, 0.01 * size}}, 5e-3 * size});
          ++kinds;
        }
  print_message("%zu lines of %zu structures\n", lines, kinds);
  assert_true(lines > 50 * kinds);
}

/// A plane of nodes on the level: rounding decides at each.
void nodes_may_be_on_the_level(void**) {
  for (const WavesKind kind : {WavesKind::network, WavesKind::sheet})
    for (uint64_t seed = 0; seed < 20; ++seed) {
      WaveDirections directions{seed, 3, {0, 0, 0.1}, {1, 1, 1}};
      const auto waves = make_ref<const Waves>(Neighbourhood{{0, 0, 0}, {1, 1, 1}, {}}, directions,
                                               kind, Parameter(0.25));
      // The height at which the sum at a node is the level: all waves run along z.
      double low = 0, high = 0.5;
      const Sums sums(*waves);
      for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (sums.at({0, 0, low}) <= 0) == (sums.at({0, 0, middle}) <= 0) ? low = middle
                                                                      : high = middle;
      }
      compare(*waves, {low, {{-2, -2}, {2, 2}}, 1e-3});
      compare(*waves, {high, {{-2, -2}, {2, 2}}, 1e-3});
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(lines_are_those_of_sums),
      cmocka_unit_test(nodes_may_be_on_the_level),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
