// SPDX-License-Identifier: Apache-2.0
// Boxes in turned grids: the mean number of cells that they meet, and the bricks near them.
#include "structure/common/grid_boxes.h"

#include <algorithm>
#include <vector>

#include "base/interval.h"
#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

Neighbourhood turned_grid(double about_z, double about_x, Vec3 size) {
  const double c = std::cos(about_z), s = std::sin(about_z);
  const double d = std::cos(about_x), t = std::sin(about_x);
  return {{0.3, -0.2, 0.1}, size, {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}}};
}

/// Whether a box of the model and one of the grid meet: no plane along a face of either, or along
/// an edge of each, separates them.
bool meets(const Neighbourhood& grid, const Box3& box, const Box3& in_grid) {
  Vec3 axes[6];
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along[axis] = 1;
    axes[axis] = along;
    axes[axis + 3] = grid.rotation.apply(along);
  }
  std::vector<Vec3> normals(axes, axes + 6);
  for (int i = 0; i < 3; ++i)
    for (int j = 3; j < 6; ++j) normals.push_back(cross(axes[i], axes[j]));
  for (const Vec3& n : normals) {
    Interval a{1e300, -1e300}, b = a;
    for (int corner = 0; corner < 8; ++corner) {
      const auto of = [&](const Box3& v) {
        return Vec3{corner & 1 ? v.max.x : v.min.x, corner & 2 ? v.max.y : v.min.y,
                    corner & 4 ? v.max.z : v.min.z};
      };
      const double x = dot(n, of(box)), y = dot(n, grid.from_grid(of(in_grid)));
      a = {std::min(a.low, x), std::max(a.high, x)};
      b = {std::min(b.low, y), std::max(b.high, y)};
    }
    if (a.high < b.low || b.high < a.low) return false;
  }
  return true;
}

void counts_cells(void**) {
  const Vec3 size{0.1, 0.14, 0.08};
  const Box3 box{{-0.4, 0.1, 0.2}, {0.5, 0.2, 0.25}};
  // Not turned: the product over the axes.
  Neighbourhood grid{{}, size, {}};
  double product = 1;
  for (int axis = 0; axis < 3; ++axis) product *= 1 + box.extent()[axis] / size[axis];
  assert_float_equal(mean_cells_met(grid, box), product, 1e-9 * product);

  grid = turned_grid(0.6, 0.4, size);
  const double expected = mean_cells_met(grid, box);
  Random random(4);
  double count = 0;
  constexpr size_t places = 400;
  for (size_t n = 0; n < places; ++n) {
    grid.origin = random.in_box({{0, 0, 0}, {1, 1, 1}});
    const Box3 around = grid.to_grid(box);
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::floor(around.min[axis] / size[axis]));
      last[axis] = static_cast<int>(std::floor(around.max[axis] / size[axis]));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const Vec3 low = Vec3{double(i), double(j), double(k)} * size;
          count += meets(grid, box, {low, low + size});
        }
  }
  // The count of one place varies by less than a fifth.
  assert_float_equal(count / places, expected, 0.03 * expected);
}

void finds_bricks(void**) {
  Random random(5);
  constexpr int side = 4, lead = 1;
  for (size_t n = 0; n < test_count(200); ++n) {
    const Vec3 size{0.05, 0.05 * random.between(1, 3), 0.05 * random.between(1, 3)};
    // Some grids are not turned, and some are turned by a quarter or by next to nothing.
    const double angles[] = {0, 1e-7, random.between(-3, 3)};
    const Neighbourhood grid = turned_grid(angles[n % 3], angles[n / 3 % 3], size);
    const Vec3 low = random.in_box({{-2, -2, -2}, {2, 2, 2}});
    const Box3 box{low, low + random.in_box({{0, 0, 0}, {2, 0.3, 0.3}})};
    const double around = random.between(0, 0.2);
    struct Near {
      CellIndex corner;
      Box3 part;
    };
    std::vector<Near> bricks;
    for_each_brick_near(grid, box, around, side, lead, [&](CellIndex corner, const Box3& part) {
      for (const Near& other : bricks) assert_false(other.corner == corner);
      bricks.push_back({corner, part});
    });
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = random.in_box(box);
      Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
      way = way * (around * random.unit() / std::max(1e-9, length(way)));
      const CellIndex cell = grid.locate(p + way).cell;
      const auto begin = [](int32_t c) {
        return static_cast<int32_t>(std::floor((c + lead) / double(side))) * side - lead;
      };
      const CellIndex corner{begin(cell.x), begin(cell.y), begin(cell.z)};
      const auto found = std::find_if(bricks.begin(), bricks.end(),
                                      [&](const Near& near) { return near.corner == corner; });
      assert_true(found != bricks.end());
      const Vec3 g = grid.to_grid(p);
      assert_true(found->part.grown(1e-9).overlaps({g, g}));
    }
  }
}

void leaves_out_far_bricks(void**) {
  // A long thin box across a turned grid: the box about it in the grid has 20 times its bricks.
  const Neighbourhood grid = turned_grid(0.78, 0.6, {0.01, 0.01, 0.01});
  const Box3 box{{0, 0, 0}, {4, 0.1, 0.1}};
  double bricks = 0;
  for_each_brick_near(grid, box, 0.02, 8, 2, [&](CellIndex, const Box3&) { ++bricks; });
  const double met = mean_cells_met(grid, box.grown(0.02)) / 512;
  assert_true(bricks > met);
  assert_true(bricks < 8 * met);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(counts_cells),
      cmocka_unit_test(finds_bricks),
      cmocka_unit_test(leaves_out_far_bricks),
  };
  return cmocka_run_group_tests_name("grid_boxes", tests, nullptr, nullptr);
}
