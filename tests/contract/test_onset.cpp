// SPDX-License-Identifier: Apache-2.0
// A point is inside where its onset is at most the parameter, except for 1e-9 of a cell about it;
// and cells of periodic structures have the same onsets.
#include <cstring>

#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 5);
  const size_t count = test_count(row.is_lattice() ? 20000 : 700);
  std::vector<std::pair<double, Ref<const Structure>>> structures;
  for (double part : {0.5, 1.0, 1.25}) {
    const double radius = row.radius() * part;
    structures.emplace_back(radius, row.kind.make(n, Parameter(radius)));
  }
  const Structure& asked = *structures[0].second;
  if (!asked.has_onset()) return;
  assert_true(asked.onset_limit() >= row.radius());
  size_t wrong = 0, held = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3 cell = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (i % 2)
      for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * 8) / 8;
    const Vec3 p = n.from_grid(cell * n.cell_size);
    const double onset = asked.onset(p);
    for (const auto& [radius, structure] : structures) {
      const bool is_inside = structure->inside(p);
      held += is_inside;
      if (is_inside != (onset <= radius) && std::abs(onset - radius) > 1e-9 * row.unit() &&
          !wrong++)
        print_error("(%.17g, %.17g, %.17g): onset %.17g, inside %d at %.17g\n", p.x, p.y, p.z,
                    onset, is_inside, radius);
    }
    if (!asked.is_periodic()) continue;
    const Vec3 shift{double(random.below(9)), double(random.below(9)), double(random.below(9))};
    const double there = asked.onset(n.from_grid((cell + shift) * n.cell_size));
    if (std::abs(there - onset) > 1e-9 * row.unit() && !wrong++)
      print_error("(%.17g, %.17g, %.17g): onset %.17g, some cells on %.17g\n", p.x, p.y, p.z, onset,
                  there);
  }
  if (wrong) fail_msg("%zu answers of %zu points are wrong", wrong, count);
  if (count > 100) assert_in_range(held, 1, 3 * count);
}

/// Onsets of many points have the bits of onsets of single points.
void test_many(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Ref<const Structure> structure = row.make({});
  if (!structure->has_onset()) return;
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 77);
  std::vector<Vec3> points(test_count(row.is_lattice() ? 1500 : 300));
  for (size_t i = 0; i < points.size(); ++i) {
    const double far = i % 7 == 0 ? 40 : 2;
    points[i] = n.from_grid(random.in_box({{-far, -far, -far}, {far, far, far}}) * n.cell_size);
  }
  std::vector<double> all(points.size());
  structure->onsets(points.data(), points.size(), all.data());
  for (size_t i = 0; i < points.size(); ++i) {
    const double one = structure->onset(points[i]);
    if (std::memcmp(&one, &all[i], sizeof one) != 0)
      fail_msg("point %zu at (%.17g, %.17g, %.17g): %.17g alone, %.17g with others", i, points[i].x,
               points[i].y, points[i].z, one, all[i]);
  }
}

}  // namespace

int main() {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures_by_point())
    if (!row.is_graded) rows.push_back(row);
  std::vector<StructureRow> all = structures_by_point();
  return run_for_each("onset", rows, test_row) + run_for_each("onsets", all, test_many);
}
