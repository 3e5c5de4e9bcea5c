// SPDX-License-Identifier: Apache-2.0
// Entries into struts of constant radius by the code for that have the bits of those by the code
// for any radius: for rays in any direction, along planes and struts, that graze or begin inside.
#include "structure/lattice/rays/constant_struts.h"

#include <limits>

#include "base/status.h"
#include "random.h"
#include "structure/lattice/cell/may_reach.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  UnitCell cell;
  double radius;
  Vec3 cell_size{1, 1, 1}, origin{};
  bool is_turned = false;
};

/// All struts that may reach a cell, and more.
CellParts parts_of(const Row& row) {
  std::vector<LatticeStrut> near;
  const Box3 cell{{0, 0, 0}, row.cell_size};
  for (int k = -3; k <= 3; ++k)
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i)
        for (const PeriodicStrut& s : periodic_struts(row.cell)) {
          const LatticeStrut strut = s.placed(Vec3{double(i), double(j), double(k)}, row.cell_size);
          if (may_reach(strut.axis, cell, strut.factor * row.radius)) near.push_back(strut);
        }
  return CellParts(near, row.cell_size, row.radius);
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Neighbourhood grid{row.origin, row.cell_size, {}};
  if (row.is_turned) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    grid.rotation.m = {c, -s, 0, s, c, 0, 0, 0, 1};
  }
  const Parameter radius(row.radius);
  const Ref<Lattice> lattice = make_ref<Lattice>(grid, row.cell, radius);
  const CellParts parts = parts_of(row);
  PartLists lists(parts);
  Random random(17);
  size_t found = 0, missed = 0;
  for (size_t n = 0; n < test_count(20000); ++n) {
    Vec3 a = random.in_box({{-3, -3, -3}, {3, 3, 3}}) * row.cell_size;
    Vec3 b = random.in_box({{-3, -3, -3}, {3, 3, 3}}) * row.cell_size;
    for (int axis = 0; axis < 3; ++axis) {
      // Through nodes, along planes and struts, and beside them by the radius.
      const double cell = row.cell_size[axis];
      if (n % 3 == 1) a[axis] = std::round(4 * a[axis] / cell) * 0.25 * cell;
      if (n % 6 == 1) b[axis] = std::round(4 * b[axis] / cell) * 0.25 * cell;
      if (n % 5 == 1 && axis != static_cast<int>(n / 5 % 3)) b[axis] = a[axis];
      if (n % 10 == 1 && axis == static_cast<int>((n / 5 + 1) % 3)) {
        a[axis] += row.radius;
        b[axis] += row.radius;
      }
    }
    a = grid.from_grid(a);
    b = grid.from_grid(b);
    const double way = length(b - a);
    if (!(way > 0)) continue;
    RaySearch one{{a, (b - a) * (1 / way)}, n % 7 == 0 ? 0.1 * way : 0, way};
    if (n % 1000 == 0) one.to = -1;
    RaySearch other = one;
    enter_constant_struts(*lattice, parts, row.radius, &one, 1, nullptr);
    StrutRays(*lattice, lists, radius, nullptr).enter(&other, 1);
    if (one.found != other.found ||
        (one.found && (one.t != other.t || !(one.normal == other.normal))))
      fail_msg(
          "ray (%.17g, %.17g, %.17g) to (%.17g, %.17g, %.17g): %d at %.17g, expected %d at "
          "%.17g",
          a.x, a.y, a.z, b.x, b.y, b.z, one.found, one.t, other.found, other.t);
    ++(one.found ? found : missed);
  }
  if (test_count(20000) < 1000) return;
  assert_true(found > 100);
  assert_true(missed > 0);
}

void stops_with_its_job(void**) {
  const Row row{"", cubic_unit_cell(), 0.1};
  const Ref<Lattice> lattice = make_ref<Lattice>(Neighbourhood{}, row.cell, Parameter(row.radius));
  const CellParts parts = parts_of(row);
  Job job;
  job.cancel();
  RaySearch search{{{0.5, 0.5, 0.5}, {1, 0, 0}}, 0, std::numeric_limits<double>::infinity()};
  try {
    enter_constant_struts(*lattice, parts, row.radius, &search, 1, &job);
    fail_msg("a cancelled search ended");
  } catch (const Error& error) {
    assert_true(error.status == Status::cancelled);
  }
}

}  // namespace

int main() {
  std::vector<Row> rows = {
      {"cubic", cubic_unit_cell(), 0.1},
      {"BCC", bcc_unit_cell(), 0.1},
      {"octet", octet_unit_cell(), 0.1},
      {"octet, thin", octet_unit_cell(), 1e-3},
      {"Kelvin, thick", kelvin_unit_cell(), 0.3},
      {"BCC, long cells", bcc_unit_cell(), 0.05, {1, 0.5, 3}, {0.1, -7, 100}},
      {"octet, turned", octet_unit_cell(), 0.08, {0.1, 0.1, 0.1}, {0.3, 0.2, 0.1}, true},
  };
  UnitCell factors = bcc_unit_cell();
  for (size_t i = 0; i < factors.struts.size(); ++i)
    factors.factors.push_back(i % 3 == 0 ? 1 : i % 3 == 1 ? 0.5 : 0);
  rows.push_back({"BCC, own factors", factors, 0.15});
  const CMUnitTest tests[] = {cmocka_unit_test(stops_with_its_job)};
  const int failed = run_for_each("constant_struts", rows, test_row);
  return failed +
         cmocka_run_group_tests_name("constant_struts, cancelled", tests, nullptr, nullptr);
}
