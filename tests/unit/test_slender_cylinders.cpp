// SPDX-License-Identifier: Apache-2.0
// Rows and rays of cylinders that are up to 10^15 times as long as they are thick.
#include <vector>

#include "shape/primitive.h"
#include "suite.h"

using namespace msq;

namespace {

constexpr int side = 16;

void check_rows(const Shape& shape, Vec3 origin, Vec3 spacing) {
  SampleGrid grid;
  grid.origin = origin;
  grid.spacing = spacing;
  grid.nx = grid.ny = grid.nz = side;
  std::vector<uint64_t> words(side * side);
  const RowBlock block{&grid, 0, side, 0, side, words.data(), 1, side};
  shape.fill_rows(block);
  for (uint64_t k = 0; k < side; ++k)
    for (uint64_t j = 0; j < side; ++j)
      for (uint64_t i = 0; i < side; ++i)
        assert_int_equal(*block.row(j, k) >> i & 1, shape.inside(grid.at(i, j, k)));
}

void test_rows_and_rays(void**) {
  for (const double length : {1e3, 1e6, 1e9, 1e12, 1e15})
    for (int n = 0; n < 20; ++n) {
      const Vec3 from{2, 3, 0.1 * n}, to{-length, -0.4, length * (1 + 0.01 * n)};
      const CylinderShape cylinder(from, to, 0.5 + 0.01 * n);
      const Box3& box = cylinder.bounds();
      const Vec3 middle = from * 0.7 + to * 0.3;
      check_rows(cylinder, box.min, box.extent() * (1.0 / (side - 1)));
      check_rows(cylinder, middle - Vec3{1, 1, 1}, {0.13, 0.13, 0.13});
      // Shorter parts of a ray than its tolerance may be overlooked.
      const Ray ray{{box.min.x, middle.y, middle.z}, {1, 0, 0}};
      double t;
      if (cylinder.ray_tolerance() < 0.1)
        assert_true(cylinder.enter(ray, 0, 3 * length, t, nullptr));
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_rows_and_rays)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
