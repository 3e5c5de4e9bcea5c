// SPDX-License-Identifier: Apache-2.0
// Which cells of a brick look beyond its faces, against the nearest seeds of points near them.
#include <vector>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/beyond_faces.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int side = beyond_faces_side;

struct Row {
  const char* name;
  double jitter;
  Vec3 scale;
  double around;
  /// Of the cells that are not at the face, how many look beyond it at most.
  double most;
};
constexpr Row rows[] = {
    {"cubes", 1, {1, 1, 1}, 0.1, 0.2},
    {"cubes, thick struts", 1, {1, 1, 1}, 0.26, 1},
    {"half the jitter", 0.5, {1, 1, 1}, 0.1, 0.05},
    {"no jitter", 0, {1, 1, 1}, 0.1, 0.01},
    {"flat", 1, {1, 1, 0.6}, 0.1, 1},
    {"long", 1, {1, 0.7, 0.7}, 0.02, 0.2},
};

/// The cell of the seed nearest to a point, among those around the brick.
std::array<int, 3> nearest(const SeedBlock& block, Vec3 p) {
  double least = 1e300;
  std::array<int, 3> cell{};
  for (size_t i = 0; i < block.positions().size(); ++i) {
    const Vec3 d = block.position(i) - p;
    if (dot(d, d) >= least) continue;
    least = dot(d, d);
    cell = block.cell(i);
  }
  return cell;
}

void tells_nearest_seeds(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(3);
  SeedBlock block;
  size_t asked = 0, beyond = 0, found = 0;
  for (size_t round = 0; round < test_count(20); ++round) {
    const FoamSeeds seeds(round, row.jitter, row.scale);
    const auto n = static_cast<int32_t>(round);
    block.move_to(seeds, {7 * n, -n, 3 * n}, side, 4.75);
    const BeyondFaces faces = find_beyond_faces(block, row.scale, row.around);
    const auto bits = [&](const std::array<int, 3>& cell) {
      return faces[static_cast<size_t>((cell[2] * side + cell[1]) * side + cell[0])];
    };
    for (int i = 0; i < side * side * side; ++i) {
      const std::array<int, 3> cell{i % side, i / side % side, i / side / side};
      for (size_t axis = 0; axis < 3; ++axis) {
        const bool is_at_face = cell[axis] == 0 || cell[axis] == side - 1;
        if (is_at_face) {
          assert_true(bits(cell) >> axis & 1);
        } else {
          ++asked;
          beyond += bits(cell) >> axis & 1;
        }
      }
    }
    for (int sample = 0; sample < 400; ++sample) {
      std::array<int, 3> cell;
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<size_t>(axis);
        cell[at] = static_cast<int>(random.below(side));
        // Most are at the faces of the grown cell, where others come nearest.
        double part = random.between(0, 1);
        if (random.below(2)) part = part < 0.5 ? 0 : 1;
        const double size = row.scale[axis];
        p[axis] = cell[at] * size - row.around + part * (size + 2 * row.around);
      }
      const std::array<int, 3> owner = nearest(block, p);
      for (size_t axis = 0; axis < 3; ++axis) {
        const bool is_low = cell[axis] < side / 2;
        const bool is_beyond = is_low ? owner[axis] < 0 : owner[axis] >= side;
        if (!is_beyond) continue;
        found += cell[axis] != 0 && cell[axis] != side - 1;
        if (!(bits(cell) >> axis & 1))
          fail_msg("cell (%d, %d, %d), axis %zu: (%g, %g, %g) is nearest to a seed beyond", cell[0],
                   cell[1], cell[2], axis, p.x, p.y, p.z);
      }
    }
  }
  if (beyond > row.most * static_cast<double>(asked))
    fail_msg("%zu of %zu cells look beyond", beyond, asked);
  // Of cubes with thin struts such points are too rare to be met here.
  if (row.scale.z == 0.6 && test_count(20) >= 20) assert_true(found > 0);
}

}  // namespace

int main() {
  std::vector<CMUnitTest> tests;
  for (const Row& row : rows)
    tests.push_back({row.name, tells_nearest_seeds, nullptr, nullptr, const_cast<Row*>(&row)});
  return _cmocka_run_group_tests("beyond_faces", tests.data(), tests.size(), nullptr, nullptr);
}
