// SPDX-License-Identifier: Apache-2.0
// The cells that edges come near, against points along them.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/vec.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/rays/cells_near_edges.h"

using namespace msq;
using namespace msq::test;

namespace {

void finds_all_and_few_others(void**) {
  Random random(11);
  size_t found_cells = 0, met_cells = 0;
  for (size_t round = 0; round < test_count(40); ++round) {
    const float reach = static_cast<float>(random.between(0.01, 0.3));
    CellBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.size[axis] = round % 2 ? 1 : static_cast<float>(random.between(0.4, 1));
      box.first[axis] = -static_cast<int>(random.below(3));
      box.count[axis] = 4 + static_cast<int>(random.below(4));
    }
    const size_t count = 1 + random.below(100);
    EdgeEnds ends;
    ends.resize(count);
    std::vector<std::array<float, 3>> a(count), b(count);
    for (size_t e = 0; e < count; ++e) {
      // Some lie in part outside the box, some along an axis, some are points.
      const Vec3 from = random.in_box({{-3, -3, -3}, {7, 7, 7}});
      Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}}) * (e % 4 == 0 ? 2 : 0.5);
      if (e % 7 == 0) way.x = way.y = 0;
      if (e % 11 == 0) way = {};
      for (int axis = 0; axis < 3; ++axis) {
        a[e][static_cast<size_t>(axis)] = static_cast<float>(from[axis]);
        b[e][static_cast<size_t>(axis)] = static_cast<float>(from[axis] + way[axis]);
      }
      ends.set(e, a[e], b[e]);
    }
    std::vector<NearCell> near;
    find_cells_near_edges(ends, box, reach, near);
    std::set<std::pair<uint32_t, uint32_t>> found;
    for (const NearCell& n : near)
      if (!found.insert({n.edge, n.cell}).second) fail_msg("edge %u is twice in a cell", n.edge);
    assert_true(std::is_sorted(near.begin(), near.end(), [](const NearCell& x, const NearCell& y) {
      return x.edge < y.edge;
    }));
    std::set<std::pair<uint32_t, uint32_t>> met;
    for (uint32_t e = 0; e < count; ++e)
      for (int step = 0; step <= 200; ++step)
        for (int corner = 0; corner < 8; ++corner) {
          uint32_t cell = 0;
          bool is_there = true;
          for (size_t axis = 3; axis-- > 0;) {
            const double at = a[e][axis] + (double(b[e][axis]) - a[e][axis]) * step / 200 +
                              (corner >> axis & 1 ? reach : -reach);
            const int n = static_cast<int>(std::floor(at / box.size[axis])) - box.first[axis];
            is_there = is_there && n >= 0 && n < box.count[axis];
            cell = cell * static_cast<uint32_t>(box.count[axis]) + static_cast<uint32_t>(n);
          }
          if (is_there) met.insert({e, cell});
        }
    for (const auto& [edge, cell] : met)
      if (!found.count({edge, cell})) fail_msg("edge %u comes near cell %u", edge, cell);
    found_cells += found.size();
    met_cells += met.size();
  }
  // Corners of the reach alone were tried: others come near, too.
  assert_true(found_cells < met_cells + met_cells / 4);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(finds_all_and_few_others)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
