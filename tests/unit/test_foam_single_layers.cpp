// SPDX-License-Identifier: Apache-2.0
// Single layers of a foam have the bits of the definition, whether the cache has the bricks of
// edges, parts of them or nothing, in any order of layers and for grids along any axes. The first
// layer builds parts alone.
#include <cmath>
#include <vector>

#include "bit_rows.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr uint64_t side = 72, layers = 9;

Ref<Foam> make_foam(const Ref<Context>& context, const Rotation& rotation, Vec3 cell) {
  return make_ref<Foam>(context, Neighbourhood{{0.2, -0.4, 0.3}, cell, rotation}, Parameter(0.12),
                        1.0, uint64_t{11}, FoamMethod::automatic, Parameter(1.0), Vec3{1, 1, 1},
                        0.0);
}

SampleGrid layer_at(double z, uint64_t ny) {
  SampleGrid grid;
  grid.origin = {-1.3, -0.7, z};
  grid.spacing = {0.06, 0.06, 0.06};
  grid.nx = side;
  grid.ny = ny;
  grid.nz = 1;
  return grid;
}

void expect_definition(const Foam& foam, const SampleGrid& grid) {
  BitRows found(grid);
  for (uint64_t j = 0; j < grid.ny; ++j)
    for (uint64_t i = 0; i < grid.nx; ++i) found.set(i, j, 0);
  foam.keep_rows(found.block(), nullptr);
  size_t differ = 0, solid = 0;
  for (uint64_t j = 0; j < grid.ny; ++j)
    for (uint64_t i = 0; i < grid.nx; ++i) {
      const bool is_inside = foam.inside(grid.at(i, j, 0));
      solid += is_inside;
      differ += found.get(i, j, 0) != is_inside;
    }
  assert_int_equal(differ, 0);
  assert_in_range(solid, 1, grid.nx * grid.ny - 1);
}

bool keeps_any(const Context& context, uint64_t id) {
  for (int32_t k = -34; k <= 30; k += 8)
    for (int32_t j = -34; j <= 30; j += 8)
      for (int32_t i = -34; i <= 30; i += 8)
        if (context.cache.keeps(id, {i, j, k})) return true;
  return false;
}

void test_scattered(void**) {
  const Rotation rotations[] = {{},
                                {{0, 0, 1, 1, 0, 0, 0, 1, 0}},
                                {{0, 1, 0, 0, 0, 1, 1, 0, 0}},
                                {{1, 0, 0, 0, 0, -1, 0, 1, 0}},
                                {{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}}};
  Random random(5);
  for (const Rotation& rotation : rotations)
    for (const Vec3 cell : {Vec3{1, 1, 1}, Vec3{1, 0.8, 0.9}}) {
      const Ref<Context> context = make_ref<Context>(1u, uint64_t{1} << 30, uint64_t{0});
      const Ref<Foam> foam = make_foam(context, rotation, cell);
      std::vector<double> heights;
      for (uint64_t k = 0; k < layers; ++k) heights.push_back(random.between(-12, 12));
      heights.push_back(heights[0]);
      heights.push_back(heights[1] + 0.06);
      for (const double z : heights) {
        expect_definition(*foam, layer_at(z, side));
        const bool is_turned = std::abs(rotation.m[0]) == 0.8;
        assert_int_equal(keeps_any(*context, foam->brick_parts_id()), !is_turned);
      }
    }
}

/// A layer, the same by tiles of its rows, and another one through the same bricks.
void test_parts(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{1} << 30, uint64_t{0});
  const Ref<Foam> foam = make_foam(context, {}, {1, 1, 1});
  expect_definition(*foam, layer_at(8.1, side));
  assert_true(keeps_any(*context, foam->brick_parts_id()));
  assert_false(keeps_any(*context, foam->id()));
  const uint64_t misses = context->cache.counters().misses;
  for (const uint64_t rows : {1, 20, 40}) expect_definition(*foam, layer_at(8.1, rows));
  assert_int_equal(context->cache.counters().misses, misses);
  expect_definition(*foam, layer_at(9.9, side));
  assert_true(keeps_any(*context, foam->id()));
  expect_definition(*foam, layer_at(8.1, side));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_scattered), cmocka_unit_test(test_parts)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
