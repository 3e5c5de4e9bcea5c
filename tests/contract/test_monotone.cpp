// SPDX-License-Identifier: Apache-2.0
// What is inside at a radius is inside at every larger one.
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  StructureRow row = *static_cast<const StructureRow*>(*state);
  row.graded_from = 0.95;  // a radius must not become negative
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 21);
  const size_t count = test_count(row.is_lattice() ? 20000 : 500);
  const Vec3 centre = n.from_grid(Vec3{});
  std::vector<Ref<const Structure>> growing;
  for (double part : {-0.9, -0.5, -0.1, -1e-6, -1e-12, 0.0, 1e-12, 1e-9, 1e-3, 0.2})
    growing.push_back(row.make(centre, part * row.radius()));
  size_t lost = 0, joined = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3 cell = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (i % 2)
      for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * 8) / 8;
    const Vec3 p = n.from_grid(cell * n.cell_size);
    bool was_inside = false;
    for (const auto& structure : growing) {
      const bool is_inside = structure->inside(p);
      if (was_inside && !is_inside && !lost++)
        print_error("(%.17g, %.17g, %.17g) is lost as the radius grows\n", p.x, p.y, p.z);
      joined += !was_inside && is_inside;
      was_inside = is_inside;
    }
  }
  if (lost) fail_msg("%zu of %zu points are lost", lost, count);
  if (count > 100) assert_in_range(joined, 1, count);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures_by_point();
  return run_for_each("monotone", rows, test_row);
}
