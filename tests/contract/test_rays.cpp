// SPDX-License-Identifier: Apache-2.0
// Rays through structures agree with membership along them.
#include "random.h"
#include "ray_check.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(Vec3{0.5, 0.5, 0.5} * grid.cell_size);
  const Ref<const Structure> structure = row.make(centre);
  Random random(row.index + 3);
  const size_t count = row.samples(row.is_lattice() ? 2000 : 700);
  int entries = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = random.in_box({{-1, -1, -1}, {2, 2, 2}});
    Vec3 b = random.in_box({{-1, -1, -1}, {2, 2, 2}});
    if (i % 4 == 0) {  // along an axis of the grid
      b = a;
      b[static_cast<int>(random.below(3))] += 1;
    }
    const Vec3 from = grid.from_grid(a * grid.cell_size), to = grid.from_grid(b * grid.cell_size);
    const Ray ray{from, (to - from) * (1 / length(to - from))};
    // Parts that are shorter than the steps of a march may be lost.
    const double part = std::max(structure->min_ray_step(), structure->ray_tolerance());
    const RayWalk walk{part, row.has_dear_points() ? 20 : 200};
    entries += check_ray(
        row.name.c_str(), ray, 0, 2 * row.unit(), walk,
        [&](Vec3 p) { return structure->inside(p); },
        [&](const Ray& r, double first, double last, double& t) {
          RaySearch search{r, first, last};
          structure->enter(&search, 1, nullptr);
          t = search.t;
          if (search.found) {
            const double normal = length(structure->normal(r, t));
            if (!(std::abs(normal - 1) < 1e-9)) fail_msg("a normal of length %.17g", normal);
          }
          return search.found;
        },
        [&](const Ray& r, double first, double last) {
          return structure->leave(r, first, last, nullptr);
        });
  }
  // Foams of fat struts in flat cells leave no holes.
  if (count > 40 && row.kind.radius < 0.5) assert_true(entries > 0);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures_by_point();
  return run_for_each("rays", rows, test_row);
}
