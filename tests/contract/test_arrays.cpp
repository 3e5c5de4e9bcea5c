// SPDX-License-Identifier: Apache-2.0
// keep_points answers as inside() does, at 10^6 points a family of structures (fewer of the slow
// METHOD_1 and POINT): random points, and
// points on borders and symmetry planes of cells, by the origin and 1000 cells away.
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

std::vector<Vec3> points_in(const StructureRow& row, Vec3 corner_cell, size_t count,
                            Random& random) {
  const Neighbourhood& grid = row.variant.grid;
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    Vec3 cell = random.in_box({{0, 0, 0}, {2, 2, 2}});
    const double parts[] = {8, 10, 1e9, 1e9, 12};  // of a cell: ties, tenths, anywhere
    const double part = parts[random.below(5)];
    for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * part) / part;
    points.push_back(grid.from_grid((corner_cell + cell) * grid.cell_size));
  }
  return points;
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const size_t count = row.samples(1000000);
  Random random(row.index + 1);
  size_t held = 0, differ = 0, forgiven = 0;
  for (Vec3 corner : {Vec3{-1, -1, -1}, Vec3{1000, -1001, 999}}) {
    const std::vector<Vec3> points = points_in(row, corner, count / 2, random);
    const Vec3 centre =
        row.variant.grid.from_grid((corner + Vec3{1, 1, 1}) * row.variant.grid.cell_size);
    const Ref<const Structure> structure = row.make(centre);
    std::vector<uint8_t> alive(points.size());
    for (size_t i = 0; i < alive.size(); ++i) alive[i] = i % 8 != 7;
    structure->keep_points(points.data(), alive.data(), points.size());
    for (size_t i = 0; i < points.size(); ++i) {
      const bool is_inside = i % 8 != 7 && structure->inside(points[i]);
      held += is_inside;
      if (alive[i] == (is_inside ? 1 : 0)) continue;
      if (may_differ(row, centre, points[i])) {
        ++forgiven;
        continue;
      }
      if (!differ++)
        print_error("(%.17g, %.17g, %.17g): alone %d, in a set %d\n", points[i].x, points[i].y,
                    points[i].z, is_inside, alive[i]);
    }
  }
  if (forgiven)
    print_message("%zu of %zu points differ within 1e-9 of the boundary\n", forgiven, count);
  if (differ) fail_msg("%zu of %zu points differ", differ, count);
  if (count > 1000) assert_in_range(held, 1, count - 1);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures();
  return run_for_each("arrays", rows, test_row);
}
