// SPDX-License-Identifier: Apache-2.0
// Clusters of the unit cell in cells of any proportions: gaps are those of all struts of
// the tiling, to the last bit, and lists stay short.
#include <cmath>
#include <limits>

#include "msq_test.h"
#include "random.h"
#include "structure/lattice/cell/strut_clusters.h"

using namespace msq;

namespace {

/// The least gap of a point among all struts within reach.
double min_gap(const std::vector<PeriodicStrut>& struts, Vec3 size, double reach, Vec3 q,
               double r) {
  double least = std::numeric_limits<double>::infinity();
  int around[3];
  for (int axis = 0; axis < 3; ++axis) around[axis] = 2 + static_cast<int>(reach / size[axis]);
  for (const PeriodicStrut& s : struts)
    for (int k = -around[2]; k <= around[2]; ++k)
      for (int j = -around[1]; j <= around[1]; ++j)
        for (int i = -around[0]; i <= around[0]; ++i) {
          const Vec3 shift{double(i), double(j), double(k)};
          const Segment axis((s.a + shift) * size, (s.b + shift) * size);
          least = std::min(least, std::sqrt(axis.distance_squared(q)) - s.factor * r);
        }
  return least;
}

void check(const UnitCell& cell, Vec3 size, double r) {
  const std::vector<PeriodicStrut> struts = periodic_struts(cell);
  const StrutClusters clusters(struts, size, {r, r}, 24);
  // As many entries as there may be, with the struts themselves and the clusters.
  assert_true(clusters.bytes() < 6 * StrutClusters::max_entries);
  const double reach = clusters.reach();
  double max_factor = 0;
  for (const PeriodicStrut& s : struts) max_factor = std::max(max_factor, s.factor);
  const size_t points = test_count(60);
  msq::test::Random random(5);
  for (size_t n = 0; n < points; ++n) {
    Vec3 fraction{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    // Near the ends of the cell, too, where struts across it are near.
    if (n % 3 == 0) fraction[static_cast<int>(n / 3 % 3)] = random.between(0, 1e-4);
    const Vec3 q = fraction * size;
    const double least = min_gap(struts, size, reach, q, r);
    const double gap = clusters.gap(fraction, q, r);
    if (least < reach - max_factor * r) {
      assert_true(gap == least);
    } else {
      assert_true(gap <= reach - max_factor * r);
    }
    assert_int_equal(clusters.holds(fraction, q, r), least <= 0);
    const StrutClusters::Cluster& cluster = clusters.at(fraction);
    assert_true(r >= cluster.outside || least > 0);
    assert_true(r < cluster.inside || least <= 0);
  }
}

void test_proportions(void**) {
  const Vec3 cells[] = {{1, 1, 1},       {1, 1, 3},     {2, 1, 12},    {1, 1, 100},
                        {1, 1, 1e4},     {1e4, 1, 1},   {1, 1e4, 1e4}, {1, 100, 1e4},
                        {1e-3, 1, 1e-3}, {1, 1, 3.3e4}, {1, 1, 1e7}};
  for (const Vec3 size : cells)
    for (const UnitCell& cell :
         {cubic_unit_cell(), bcc_unit_cell(), octet_unit_cell(), reentrant_unit_cell()})
      for (const double r : {0.1, 2.0}) check(cell, size, r * min_component(size));
}

void test_factors(void**) {
  UnitCell cell = octet_unit_cell();
  for (size_t i = 0; i < cell.struts.size(); ++i) cell.factors.push_back(0.5 + 0.1 * double(i));
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{1, 1, 1e4}, Vec3{1, 1e3, 1e3}})
    check(cell, size, 0.2);
}

/// Cells of 1 : 1 : 10^4 once listed nearly all struts in each of 24^3 clusters, 10^7 entries and
/// more.
void test_slender_is_short(void**) {
  const auto bytes = [](const UnitCell& cell, Vec3 size, Interval radius) {
    const std::vector<PeriodicStrut> struts = periodic_struts(cell);
    return StrutClusters(struts, size, radius, 24).bytes();
  };
  for (const UnitCell& cell : {bcc_unit_cell(), octet_unit_cell()})
    for (const Interval radius : {Interval{0.1, 0.1}, Interval{0, 4}}) {
      assert_true(bytes(cell, {1, 1, 1}, radius) < 2000000);
      assert_true(bytes(cell, {1, 1, 1e4}, radius) < 3000000);
      assert_true(bytes(cell, {1e-2, 1e-2, 1e4}, radius) < 6 * StrutClusters::max_entries);
      assert_true(bytes(cell, {1, 1, 1e12}, radius) < 6 * StrutClusters::max_entries);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_proportions),
      cmocka_unit_test(test_factors),
      cmocka_unit_test(test_slender_is_short),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
