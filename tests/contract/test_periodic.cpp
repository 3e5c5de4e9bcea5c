// SPDX-License-Identifier: Apache-2.0
// Lattices repeat: a point and its copies whole cells away are inside together, unless the boundary
// passes within 1e-9 of a cell of them.
#include <set>
#include <string>
#include <vector>

#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  const Ref<const Structure> structure = row.make({});
  const double reach = 1e-9 * row.unit();
  const Ref<const Structure> thinner = row.make({}, -reach), thicker = row.make({}, reach);
  Random random(row.index + 31);
  const size_t count = test_count(50000);
  size_t differ = 0, at_boundary = 0, held = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3 cell = random.in_box({{0, 0, 0}, {1, 1, 1}});
    if (i % 3 == 0)
      for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * 16) / 16;
    Vec3 shift;
    for (int axis = 0; axis < 3; ++axis)
      shift[axis] = i % 2 ? static_cast<double>(random.below(2001)) - 1000
                          : static_cast<double>(random.below(3)) - 1;
    const Vec3 p = n.from_grid(cell * n.cell_size), q = n.from_grid((cell + shift) * n.cell_size);
    const bool is_inside = structure->inside(p);
    held += is_inside;
    if (structure->inside(q) == is_inside) continue;
    if (!thinner->inside(p) && thicker->inside(p)) {
      ++at_boundary;
      continue;
    }
    if (!differ++)
      print_error("(%.17g, %.17g, %.17g) is %d; (%g, %g, %g) cells away %d\n", p.x, p.y, p.z,
                  is_inside, shift.x, shift.y, shift.z, !is_inside);
  }
  if (at_boundary) print_message("%zu points lie on the boundary\n", at_boundary);
  if (differ) fail_msg("%zu of %zu points differ", differ, count);
  if (count > 1000) assert_in_range(held, 1, count - 1);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures_by_point();
  // Neither a varying radius repeats nor cells that vary or are warped; beams are a list; waves
  // repeat with a tile alone (unit/test_waves.cpp); members of a combination have grids of their
  // own.
  const std::set<std::string> aperiodic = {
      "mixed",    "graded period", "graded lattice", "warped",  "warped lattice", "waves",
      "combined", "blended",       "smooth",         "sampled", "sampled lattice"};
  std::erase_if(rows, [&](const StructureRow& r) {
    return !r.is_lattice() || r.is_beams() || r.is_graded || aperiodic.count(r.kind.family);
  });
  return run_for_each("periodic", rows, test_row);
}
