// SPDX-License-Identifier: Apache-2.0
// Which bricks may own edges near the cells of a brick, against the edges of the bricks around it.
#include <vector>

#include "msq_test.h"
#include "structure/foam/rays/ray_brick.h"

using namespace msq;

namespace {

constexpr int side = RayBrick::side;

struct Row {
  const char* name;
  double jitter;
  Vec3 scale;
  double radius;
  /// How many times as many bricks are named as own an edge near the cell, at most.
  double most;
};
constexpr Row rows[] = {
    {"cubes", 1, {1, 1, 1}, 0.1, 1.25},
    {"cubes, thin struts", 1, {1, 1, 1}, 0.01, 1.35},
    {"cubes, thick struts", 1, {1, 1, 1}, 0.2, 1.25},
    {"cubes, struts that reach half a brick", 1, {1, 1, 1}, 0.26, 1.8},
    {"half the jitter", 0.5, {1, 1, 1}, 0.1, 1.2},
    {"little jitter", 0.01, {1, 1, 1}, 0.1, 1.1},
    {"no jitter", 0, {1, 1, 1}, 0.1, 1.1},
    {"flat", 1, {1, 1, 0.9}, 0.1, 1.25},
    {"long", 1, {1, 0.85, 0.85}, 0.1, 1.25},
};

void names_owners(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  size_t named = 0, needed = 0;
  for (size_t round = 0; round < test_count(10); ++round) {
    const FoamSeeds seeds(round, row.jitter, row.scale);
    for (const int reach : RayBrick::reach(seeds, row.radius)) assert_true(reach <= side / 2);
    const auto n = static_cast<int32_t>(round);
    const CellIndex corner{7 * n, -n, 3 * n};
    const RayBrick brick(seeds, corner, row.radius);
    std::vector<uint8_t> owning(side * side * side);
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const int way[3] = {i, j, k};
          const CellIndex at{corner.x + side * i, corner.y + side * j, corner.z + side * k};
          // Edges in single precision may seem to come a little nearer.
          const RayBrick around(seeds, at, row.radius - 1e-5);
          for (int c = 0; c < side * side * side; ++c) {
            const int cell[3] = {c % side, c / side % side, c / side / side};
            if (around.list(cell[0] - side * i, cell[1] - side * j, cell[2] - side * k).empty())
              continue;
            unsigned number = 0;
            for (int axis = 0; axis < 3; ++axis) {
              if (way[axis] == 0) continue;
              assert_int_equal(way[axis], cell[axis] < side / 2 ? -1 : 1);
              number |= 1u << axis;
            }
            owning[static_cast<size_t>(c)] |= static_cast<uint8_t>(1u << number);
          }
        }
    for (int c = 0; c < side * side * side; ++c) {
      const int x = c % side, y = c / side % side, z = c / side / side;
      const unsigned bits = brick.owning(seeds, row.radius, x, y, z),
                     those = owning[static_cast<size_t>(c)];
      if (those & ~bits)
        fail_msg("round %zu: near cell (%d, %d, %d) are owners in bricks %02x, named are %02x",
                 round, x, y, z, those, bits);
      for (unsigned i = 1; i < 8; ++i) {
        named += bits >> i & 1;
        needed += those >> i & 1;
      }
    }
  }
  if (test_count(10) < 10) return;
  if (static_cast<double>(named) > row.most * static_cast<double>(needed))
    fail_msg("%zu bricks are named, %zu are needed", named, needed);
}

/// Where owners may be farther away than the bricks next to a cell, all of these are named.
void names_all_if_edges_reach_far(void**) {
  const FoamSeeds seeds(1, 1, {1, 1, 0.6});
  const RayBrick brick(seeds, {0, 0, 0}, 0.1);
  for (int c = 0; c < side * side * side; ++c)
    assert_int_equal(brick.owning(seeds, 0.1, c % side, c / side % side, c / side / side), 0xff);
}

}  // namespace

int main() {
  std::vector<CMUnitTest> tests;
  for (const Row& row : rows)
    tests.push_back({row.name, names_owners, nullptr, nullptr, const_cast<Row*>(&row)});
  tests.push_back(cmocka_unit_test(names_all_if_edges_reach_far));
  return _cmocka_run_group_tests("owning_bricks", tests.data(), tests.size(), nullptr, nullptr);
}
