// SPDX-License-Identifier: Apache-2.0
// Rows of a foam with few samples in each cell: points are evaluated, unless the bricks of edges
// are in the cache. Both give the bits of the definition.
#include <cmath>
#include <vector>

#include "bit_rows.h"
#include "msq_test.h"
#include "structure/foam/foam.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  double radius, jitter, density;
  Vec3 stretch;
  double weight;
  bool is_turned;
  double samples_across;  // a cell
};
constexpr Row rows[] = {
    {"plain", 0.1, 1, 1, {1, 1, 1}, 0, false, 8},
    {"turned", 0.1, 1, 1, {1, 1, 1}, 0, true, 8},
    {"thick", 0.2, 1, 1, {1, 1, 1}, 0, false, 4.5},
    {"no jitter", 0.1, 0, 1, {1, 1, 1}, 0, false, 8},
    {"graded", 0.05, 1, 6, {1, 1, 1}, 0, false, 4},
    {"stretched", 0.1, 1, 1, {1.5, 1, 1}, 0, false, 5},
    {"weighted", 0.1, 1, 1, {1, 1, 1}, 0.5, false, 5},
};

/// A structure whose bricks are in the cache of its own context, or are not.
struct Made {
  Ref<Context> context;
  Ref<const Structure> foam;
};

Made make(const Row& row) {
  Made made;
  made.context = make_ref<Context>(1u, uint64_t{1} << 30, uint64_t{0});
  Neighbourhood grid;
  if (row.is_turned) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    grid.rotation.m = {c, -s, 0, s, c, 0, 0, 0, 1};
  }
  made.foam =
      make_ref<Foam>(made.context, grid, Parameter(row.radius), row.jitter, uint64_t{7},
                     FoamMethod::automatic, Parameter(row.density), row.stretch, row.weight);
  return made;
}

void draws_bricks_that_are_kept(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  SampleGrid grid;
  const double pitch = 1 / row.samples_across;
  grid.origin = {0.03, 0.01, 0.37};
  grid.spacing = {pitch, pitch, pitch};
  grid.nx = grid.ny = static_cast<uint64_t>(8 * row.samples_across);
  grid.nz = 1;
  const Made evaluated = make(row), drawn = make(row);
  drawn.foam->for_each_strut(
      {{-1, -1, -1}, {9, 9, 2}}, [](Vec3, Vec3, double) {}, nullptr);
  const CellCache::Counters before = drawn.context->cache.counters();
  BitRows found[2] = {BitRows(grid), BitRows(grid)};
  for (BitRows& each : found)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) each.set(i, j, 0);
  evaluated.foam->keep_rows(found[0].block(), nullptr);
  drawn.foam->keep_rows(found[1].block(), nullptr);
  size_t solid = 0, differ = 0;
  for (uint64_t j = 0; j < grid.ny; ++j)
    for (uint64_t i = 0; i < grid.nx; ++i) {
      const bool is_inside = evaluated.foam->inside(grid.at(i, j, 0));
      solid += is_inside;
      differ += found[0].get(i, j, 0) != is_inside;
      differ += found[1].get(i, j, 0) != is_inside;
    }
  assert_int_equal(differ, 0);
  assert_in_range(solid, 1, grid.nx * grid.ny - 1);
  assert_int_equal(evaluated.context->cache.counters().misses, 0);
  const CellCache::Counters after = drawn.context->cache.counters();
  assert_int_equal(after.misses, before.misses);
  assert_true(after.hits > before.hits);
}

}  // namespace

int main() {
  std::vector<CMUnitTest> tests;
  for (const Row& row : rows)
    tests.push_back(
        {row.name, draws_bricks_that_are_kept, nullptr, nullptr, const_cast<Row*>(&row)});
  return _cmocka_run_group_tests("foam_kept_bricks", tests.data(), tests.size(), nullptr, nullptr);
}
