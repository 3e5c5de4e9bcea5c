// SPDX-License-Identifier: Apache-2.0
// Struts so thin that the single-precision ends of foam edges matter: around short edges, at a
// pitch of a thousandth of the radius, spans give the point query's bits. And struts that are thin
// beside the cell of their owner, which rays meet by coordinates from its middle.
#include <algorithm>

#include "bit_rows.h"
#include "random.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/foam.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void spans_of_thin_struts_are_the_predicates(void**) {
  constexpr uint64_t seed = 7;
  const FoamSeeds seeds(seed, 1, {1, 1, 1});
  size_t count = 0, wrong = 0, edges = 0;
  for (double radius : {0.001, 0.003})
    for (int x = 0; x < 8; x += EdgeBrick::side) {
      const EdgeBrick brick(seeds, {x, 0, 0});
      for (const FoamEdge& edge : brick.edges()) {
        const Vec3 a = Vec3{edge.a[0], edge.a[1], edge.a[2]} + Vec3{double(x), 0, 0};
        const Vec3 b = Vec3{edge.b[0], edge.b[1], edge.b[2]} + Vec3{double(x), 0, 0};
        const double l = length(b - a);
        if (l < 0.008 || l > 0.03 || ++edges % 8 != 0) continue;
        const Ref<const Structure> foam =
            make_ref<Foam>(make_ref<Context>(1u, uint64_t{1} << 24, uint64_t{0}), Neighbourhood{},
                           Parameter(radius), 1.0, seed, FoamMethod::direct);
        SampleGrid grid;
        const Vec3 low = min(a, b) - Vec3{radius, radius, radius};
        const Vec3 extent = max(a, b) + Vec3{radius, radius, radius} - low;
        grid.nx = static_cast<uint64_t>(8000 * test_scale()) + 200;
        grid.ny = grid.nz = 9;
        grid.origin = low;
        grid.spacing = extent * Vec3{1.0 / static_cast<double>(grid.nx), 1.0 / 9, 1.0 / 9};
        BitRows rows(grid);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j) set_bits(rows.block().row(j, k), 0, grid.nx - 1);
        foam->keep_rows(rows.block(), nullptr);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j)
            for (uint64_t i = 0; i < grid.nx; ++i, ++count)
              wrong += rows.get(i, j, k) != foam->inside(grid.at(i, j, k));
      }
    }
  print_message("%zu samples, %zu differ\n", count, wrong);
  assert_true(count > 0);
  assert_int_equal(wrong, 0);
}

/// Towards the middles of struts, with a radius that counts as a field: seeds are graded.
void rays_meet_thin_struts(void**) {
  Random random(11);
  size_t asked = 0, missed = 0;
  for (double radius : {0.01, 0.003, 0.001}) {
    const Ref<const Structure> foam =
        make_ref<Foam>(make_ref<Context>(1u, uint64_t{1} << 24, uint64_t{0}), Neighbourhood{},
                       Parameter(radius), 1.0, uint64_t{7}, FoamMethod::direct, Parameter(1.001));
    std::vector<RaySearch> rays;
    foam->for_each_strut(
        Box3{{0, 0, 0}, {3, 3, 3}},
        [&](Vec3 a, Vec3 b, double) {
          if (length(b - a) < 0.1) return;
          for (int n = 0; n < 4; ++n) {
            const Vec3 middle = a + (b - a) * random.between(0.2, 0.8);
            const Vec3 way = random.in_box(Box3{{-1, -1, -1}, {1, 1, 1}});
            const double far = random.between(0.1, 0.5);
            const Vec3 direction = way * (1 / length(way));
            if (foam->inside(middle))
              rays.push_back({{middle - direction * far, direction}, 0, far});
          }
        },
        nullptr);
    foam->enter(rays.data(), rays.size(), nullptr);
    asked += rays.size();
    missed += static_cast<size_t>(
        std::count_if(rays.begin(), rays.end(), [](const RaySearch& ray) { return !ray.found; }));
  }
  print_message("%zu rays, %zu miss a strut\n", asked, missed);
  assert_true(asked > 1000);
  assert_int_equal(missed, 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(spans_of_thin_struts_are_the_predicates),
                              cmocka_unit_test(rays_meet_thin_struts)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
