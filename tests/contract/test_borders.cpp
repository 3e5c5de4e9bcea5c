// SPDX-License-Identifier: Apache-2.0
// Solids run on over the borders of cells: a point of a face and the points just beside it, which
// belong to different cells, are inside together, unless the boundary passes within 1e-9 of a cell.
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 11);
  const size_t count = test_count(row.is_lattice() ? 8000 : 300);
  size_t torn = 0, at_boundary = 0;
  // The structure by the origin and 1000 cells away, and the same a little thinner and thicker.
  struct Place {
    double far;
    Ref<const Structure> structure, thinner, thicker;
  };
  std::vector<Place> places;
  const double reach = 1e-9 * row.unit();
  for (double far : {0.0, 1000.0}) {
    const Vec3 centre = n.from_grid(Vec3{far, -far, far} * n.cell_size);
    places.push_back({far, row.make(centre), row.make(centre, -reach), row.make(centre, reach)});
  }
  for (size_t i = 0; i < count; ++i) {
    const int axis = static_cast<int>(i % 3);
    const auto& [far, structure, thinner, thicker] = places[i % 4 == 3];
    Vec3 cell = random.in_box({{-2, -2, -2}, {2, 2, 2}});
    cell[axis] = std::floor(cell[axis]);
    if (i % 5 == 4) cell[(axis + 1) % 3] = std::floor(cell[(axis + 1) % 3]);  // on an edge
    cell = cell + Vec3{far, -far, far};
    // Cells around an axis meet there at all angles.
    if (row.kind.family == "warped" && std::hypot(cell.x, cell.y) < 1e-6) continue;
    const Vec3 on_face = n.from_grid(cell * n.cell_size);
    // The next number either way, and what is out of reach of all rounding.
    Vec3 normal;
    normal[axis] = 1;
    normal = n.rotation.apply(normal);
    const double step = 1e-12 * row.unit() * (1 + far);
    std::vector<Vec3> near = {on_face + normal * step, on_face - normal * step};
    for (int a = 0; a < 3; ++a)
      for (double to : {-1e300, 1e300}) {
        near.push_back(on_face);
        near.back()[a] = std::nextafter(on_face[a], to);
      }
    const bool is_inside = structure->inside(on_face);
    for (const Vec3& p : near) {
      if (structure->inside(p) == is_inside) continue;
      // The distance to the struts is continuous: the boundary is near if a radius that is as
      // much smaller leaves the point out, and one as much larger holds it.
      if (!thinner->inside(p) && thicker->inside(p)) {
        ++at_boundary;
        continue;
      }
      if (!torn++)
        print_error("(%.17g, %.17g, %.17g) on a face: %d; beside it %d\n", on_face.x, on_face.y,
                    on_face.z, is_inside, !is_inside);
    }
  }
  if (at_boundary) print_message("%zu pairs straddle the boundary\n", at_boundary);
  if (torn) fail_msg("%zu pairs of %zu are torn apart", torn, 8 * count);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures_by_point();
  // A radius of 0 has no smaller one to compare with.
  for (StructureRow& row : rows) row.graded_from = 0.01;
  return run_for_each("borders", rows, test_row);
}
