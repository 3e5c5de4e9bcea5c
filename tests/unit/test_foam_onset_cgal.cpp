// SPDX-License-Identifier: Apache-2.0
// The onset of foams against the distance to all edges of a global Delaunay triangulation's dual,
// and the distance outside a foam of constant radius.
#include <limits>

#include "foam_diagram.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/foam/point/onset.h"
#include "strut/segment.h"

using namespace msq;
using namespace msq::test;

namespace {

void check(uint64_t seed, double jitter, Vec3 scale, double tolerance) {
  const FoamSeeds seeds(seed, jitter, scale);
  std::vector<Segment> edges;
  for (const DiagramEdge& e : foam_diagram(seeds, 6)) {
    const Vec3 reach = max(max(e.a, e.b), (min(e.a, e.b)) * -1.0);
    if (max_component(reach) < 4) edges.emplace_back(e.a, e.b);
  }
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{0}, uint64_t{0});
  const double radius = 0.1;
  const Neighbourhood grid{{}, scale, {}};
  const Ref<const Structure> foam =
      make_ref<Foam>(context, grid, Parameter(radius), jitter, seed, FoamMethod::automatic);
  Random random(seed + 1);
  double greatest = 0;
  for (size_t i = 0; i < test_count(2500); ++i) {
    const Vec3 p = random.in_box({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
    double least = std::numeric_limits<double>::infinity();
    for (const Segment& s : edges) least = std::min(least, s.distance_squared(p));
    const double wanted = std::sqrt(least);
    const Neighbourhood::Located located = grid.locate(p);
    const double onset = foam_onset(seeds, located.cell, located.fraction * scale);
    if (!(std::abs(onset - wanted) <= tolerance))
      fail_msg("onset %.17g at (%.17g, %.17g, %.17g), not %.17g", onset, p.x, p.y, p.z, wanted);
    const double d = foam->distance(p);
    if (wanted > radius) assert_true(d > 0);
    assert_true(std::abs(d - (wanted - radius)) <= 2e-9 + tolerance);
    greatest = std::max(greatest, onset);
  }
  // Beyond the first radius of the search.
  if (test_scale() >= 0.5) assert_true(greatest > 0.25);
}

void test_cubes(void**) {
  for (double jitter : {1.0, 0.5, 0.01})
    for (uint64_t seed : {1, 2}) check(seed, jitter, {1, 1, 1}, 1e-10);
}

void test_uneven_cells(void**) {
  check(3, 1, {1, 0.5, 0.75}, 1e-10);
  check(4, 0.5, {0.25, 1, 1}, 1e-10);
}

/// Seeds at cell centres: edges are those of a cubic lattice.
void test_without_jitter(void**) {
  const FoamSeeds seeds(1, 0, {1, 1, 1});
  Random random(3);
  for (size_t i = 0; i < test_count(20000); ++i) {
    const Vec3 q = random.in_box({{0, 0, 0}, {1, 1, 1}});
    // Distances to the borders; the nearest edge lies along the axis of the largest.
    double d[3];
    for (int axis = 0; axis < 3; ++axis) d[axis] = std::min(q[axis], 1 - q[axis]);
    std::sort(d, d + 3);
    const double onset = foam_onset(seeds, {5, -3, 2}, q);
    assert_true(std::abs(onset - std::hypot(d[0], d[1])) <= 1e-12);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_cubes), cmocka_unit_test(test_uneven_cells),
                              cmocka_unit_test(test_without_jitter)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
