// SPDX-License-Identifier: Apache-2.0
// Stratified samples are answered as their points are alone, by either method, on the structure's
// grid and on a turned one, however large their cells are; and so are the grids that are asked
// point by point.
#include "query/grid_points.h"
#include "query/membership.h"
#include "query/stratified_points.h"
#include "random.h"
#include "shape/primitive.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void check_set(const StructureRow& row, Vec3 centre, const Model& model, const Structure& structure,
               const PointSet& set, const Box3& box) {
  std::vector<Vec3> points(set.count());
  set.read(0, set.count(), points.data());
  std::vector<uint32_t> numbers(set.count());
  for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  std::vector<Vec3> gathered(set.count());
  set.gather(0, numbers, gathered.data());
  std::vector<uint8_t> inside(set.count());
  for (QueryMethod method : {QueryMethod::automatic, QueryMethod::point, QueryMethod::set}) {
    std::fill(inside.begin(), inside.end(), 77);
    set_membership(model, model.resolved(0), set, {method, 0, 0}, inside.data(), nullptr);
    for (size_t i = 0; i < points.size(); ++i) {
      assert_true(points[i] == gathered[i]);
      const uint8_t expected = box.contains(points[i]) && structure.inside(points[i]);
      if (inside[i] != expected && !may_differ(row, centre, points[i]))
        fail_msg("method %d, point %zu at (%.17g, %.17g, %.17g): alone %d, in the set %d",
                 static_cast<int>(method), i, points[i].x, points[i].y, points[i].z, expected,
                 inside[i]);
    }
  }
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 77);
  const Vec3 centre = n.from_grid(Vec3{});
  const Ref<const Structure> structure = row.make(centre);
  const double half = 1.5 * row.unit();
  const Box3 box{centre - Vec3{half, half, half}, centre + Vec3{half, half, half}};
  const auto shape = make_ref<BoxShape>(box);
  const Model model(shared_context(), shape, std::vector<Ref<const Structure>>{structure});
  const size_t count = std::min<size_t>(row.samples(40000), 2000);
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Rotation turned{{c, -s, 0, s, c, 0, 0, 0, 1}};
  for (const uint64_t per_cell : {uint64_t{1}, uint64_t{7}, uint64_t{4500}}) {
    // More points in a cell than a part has: of some rows, as there are many.
    if (per_cell == 4500 && (row.has_dear_points() || row.has_dear_cells() || row.index % 16 != 0))
      continue;
    const double cells = std::max(1.0, static_cast<double>(count) / static_cast<double>(per_cell));
    const auto side = static_cast<uint64_t>(std::max(1.0, std::cbrt(cells)));
    Strata strata;
    strata.rotation = per_cell == 7 ? turned : n.rotation;
    strata.counts = {side, per_cell == 4500 ? 1 : side + 1, side};
    strata.per_cell = per_cell;
    strata.seed = random.bits();
    strata.origin = centre - strata.rotation.apply(Vec3{half, half, half} * 1.1);
    strata.cell_size = Vec3{1, 1, 1} * (2.2 * half / static_cast<double>(side));
    check_set(row, centre, model, *structure, StratifiedPoints(strata), box);
  }
  SampleGrid grid;
  grid.nx = grid.ny = static_cast<uint64_t>(std::cbrt(static_cast<double>(count))) + 1;
  grid.nz = 3;
  grid.origin = box.min;
  grid.spacing = box.extent() * (1 / static_cast<double>(grid.nx));
  check_set(row, centre, model, *structure, GridPoints(grid), box);
}

}  // namespace

int main() {
  // Of the paper's methods some rows: their cells are dear, and asked in full by other tests.
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures())
    if (row.index % 8 == 0 || !(row.has_dear_points() || row.has_dear_cells())) rows.push_back(row);
  return run_for_each("strata", rows, test_row);
}
