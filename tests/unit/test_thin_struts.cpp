// SPDX-License-Identifier: Apache-2.0
// Struts so thin that the single-precision ends of foam edges matter: around short edges, at a
// pitch of a thousandth of the radius, spans give the point query's bits.
#include "bit_rows.h"
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(spans_of_thin_struts_are_the_predicates)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
