// SPDX-License-Identifier: Apache-2.0
// At the very boundary: the radius at which a sample comes inside is found to the last bit, and
// there, and one number below, points in sets and in grids answer as the point alone does.
#include <map>
#include <tuple>

#include "bit_rows.h"
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// A radius for each of some points.
class RadiusOfPoint final : public Field {
 public:
  explicit RadiusOfPoint(double most) : most_(most) {}
  void set(Vec3 p, double radius) { radii_[{p.x, p.y, p.z}] = radius; }
  double at(Vec3 p) const override { return radii_.at({p.x, p.y, p.z}); }
  Interval range() const override { return {0, most_}; }
  Interval range(const Box3&) const override { return range(); }
  void describe(HashInput&) const override {}

 private:
  double most_;
  std::map<std::tuple<double, double, double>, double> radii_;
};

/// The least radius up to `most` that holds a point, by bisection down to neighbouring numbers; 0
/// if there is none.
double threshold(const StructureRow& row, Vec3 p, double most) {
  const auto holds = [&](double r) {
    return row.kind.make(row.variant.grid, Parameter(r))->inside(p);
  };
  double low = 1e-3 * most, high = most;
  if (holds(low) || !holds(high)) return 0;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return high;
    (holds(middle) ? high : low) = middle;
  }
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 51);
  const double most = row.radius();
  size_t found = 0, differ = 0;
  Ref<RadiusOfPoint> radii = make_ref<RadiusOfPoint>(most);
  std::vector<Vec3> points;
  std::vector<double> thresholds;
  for (size_t tries = test_count(row.is_lattice()    ? 6
                                 : row.is_method_1() ? 15
                                 : row.is_method_2() ? 60
                                                     : 8);
       tries > 0; --tries) {
    const Vec3 cell = random.in_box({{-1, -1, -1}, {0.5, 0.5, 0.5}});
    const Vec3 p = n.from_grid(cell * n.cell_size);
    const double r = threshold(row, p, most);
    if (r == 0) continue;
    ++found;
    points.push_back(p);
    thresholds.push_back(r);
    if (row.has_dear_cells() || row.has_dear_points()) continue;  // their grids are sets
    // A small grid with p among its samples.
    SampleGrid grid;
    const double step = row.unit() / random.between(5, 60);
    grid.spacing = {step, 0.9 * step, 1.1 * step};
    grid.origin = p;
    grid.nx = 70;
    grid.ny = grid.nz = 2;
    for (double radius : {r, std::nextafter(r, 0)}) {
      const Ref<const Structure> structure = row.kind.make(n, Parameter(radius));
      BitRows rows(grid);
      for (uint64_t k = 0; k < 2; ++k)
        for (uint64_t j = 0; j < 2; ++j) set_bits(rows.block().row(j, k), 0, grid.nx - 1);
      structure->keep_rows(rows.block(), nullptr);
      for (uint64_t k = 0; k < 2; ++k)
        for (uint64_t j = 0; j < 2; ++j)
          for (uint64_t i = 0; i < grid.nx; ++i)
            differ += rows.get(i, j, k) != structure->inside(grid.at(i, j, k));
    }
  }
  if (row.kind.holds_beams) {
    assert_int_equal(differ, 0);
    return;
  }
  // All points at once, each with its own radius.
  const Ref<const Structure> structure = row.kind.make(n, Parameter(Ref<const Field>(radii)));
  for (bool is_below : {false, true}) {
    for (size_t i = 0; i < points.size(); ++i)
      radii->set(points[i], is_below ? std::nextafter(thresholds[i], 0) : thresholds[i]);
    std::vector<uint8_t> alive(points.size(), 1);
    structure->keep_points(points.data(), alive.data(), points.size());
    for (size_t i = 0; i < points.size(); ++i) differ += alive[i] != structure->inside(points[i]);
  }
  if (differ == 0) return;
  // Without jitter, where rounding decides, a threshold is within 1e-9 of the boundary by its
  // nature.
  if (row.is_method_2() && row.kind.jitter < 0.01)
    print_message("%zu answers at %zu thresholds differ\n", differ, found);
  else
    fail_msg("%zu answers at %zu thresholds differ", differ, found);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures())
    if (!row.is_graded) rows.push_back(row);
  return run_for_each("thresholds", rows, test_row);
}
