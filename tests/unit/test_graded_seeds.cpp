// SPDX-License-Identifier: Apache-2.0
// Seeds of a graded foam: how many there are, where they are, and that searches find them.
#include <algorithm>
#include <set>
#include <string>

#include "field/gradient.h"
#include "graded_cells.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/seed_trees.h"

using namespace msq;
using namespace msq::test;

namespace {

Neighbourhood turned_grid() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{0.3, 0.2, -0.7}, {1, 0.75, 0.5}, {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}}};
}

/// Rises from 1 to `high` along an oblique line through the grid's origin.
Parameter ramp(const Neighbourhood& grid, double high) {
  const Vec3 half = Vec3{2, 1, -1} * grid.cell_size;
  return Parameter(Ref<const Field>(
      make_ref<GradientField>(grid.from_grid(half * -1.0), 1.0, grid.from_grid(half), high)));
}

std::shared_ptr<const GradedSeeds> seeds_of(Parameter density, double jitter = 1,
                                            const Neighbourhood& grid = {}) {
  const FoamSeeds cells(5, jitter, grid.cell_size * (1 / max_component(grid.cell_size)));
  return std::make_shared<const GradedSeeds>(cells, grid, std::move(density));
}

void test_density_1_is_the_foam(void**) {
  const Neighbourhood grid = turned_grid();
  for (double density : {0.0, 0.5, 1.0}) {
    const auto seeds = seeds_of(Parameter(density), 0.7, grid);
    for (const GradedSeed& seed : graded_cells(*seeds, -6, 6)) {
      assert_int_equal(seed.leaf.level, 0);
      const CellIndex c = seed.leaf.cell;
      const Vec3 expected = seeds->cells().at({}, c.x, c.y, c.z);
      assert_true(seed.position == expected);
    }
    assert_int_equal(graded_cells(*seeds, -6, 6).size(), 12 * 12 * 12);
  }
}

void test_powers_of_8_are_met(void**) {
  size_t wanted = 8;
  for (double density = 8; density <= GradedSeeds::max_density; density *= 8, wanted *= 8) {
    const auto seeds = seeds_of(Parameter(density));
    assert_int_equal(graded_cells(*seeds, 0, 1).size(), wanted);
    if (wanted < 1000) assert_int_equal(graded_cells(*seeds, -2, 2).size(), 64 * wanted);
  }
}

/// Between powers of 8 the seeds of a cell are a sum of independent leaves and splits: of a node
/// with m expected, 1 or 8 with variance (m - 1) (8 - m), and 8^l such nodes a cell.
void test_constant_density_is_met_on_average(void**) {
  for (double density : {1.3, 2.0, 3.0, 5.5, 7.9, 11.0, 24.0, 50.0}) {
    const int half = density < 8 ? 10 : 5;
    const double cells = 8.0 * half * half * half;
    const size_t count = graded_cells(*seeds_of(Parameter(density)), -half, half).size();
    const double nodes = density < 8 ? 1 : 8, m = density / nodes;
    const double error = std::sqrt(cells * nodes * (m - 1) * (8 - m));
    print_message("density %g: %zu seeds, %g expected, standard error %g\n", density, count,
                  cells * density, error);
    assert_true(std::abs(static_cast<double>(count) - cells * density) <= 4 * error);
  }
}

void test_leaves_fill_cells_and_hold_their_seeds(void**) {
  for (const Neighbourhood& grid : {Neighbourhood{}, turned_grid()}) {
    const auto seeds = seeds_of(ramp(grid, 600), 1, grid);
    double volume = 0;
    std::set<int> levels;
    CellIndex cell;
    uint32_t order = 0;
    for (const GradedSeed& seed : graded_cells(*seeds, -3, 3)) {
      const GradedSeeds::Node& leaf = seed.leaf;
      const Vec3 in_cell = seeds->in_leaf(leaf);
      for (int axis = 0; axis < 3; ++axis) {
        assert_true(in_cell[axis] >= leaf.low[axis]);
        assert_true(in_cell[axis] < leaf.low[axis] + leaf.size());
        // A multiple of 2^-(21 + level).
        const double scaled = std::ldexp(in_cell[axis], 21 + leaf.level);
        assert_true(scaled == std::floor(scaled));
      }
      if (leaf.cell == cell && volume > 0) assert_true(leaf.order() > order);
      cell = leaf.cell;
      order = leaf.order();
      volume += leaf.size() * leaf.size() * leaf.size();
      levels.insert(leaf.level);
    }
    assert_true(volume == 6 * 6 * 6);
    assert_int_equal(levels.size(), 5);
  }
}

/// The same seeds, in the same order, from any cell; and the nearest ones.
void test_searches(void**) {
  const Neighbourhood grid = turned_grid();
  const auto seeds = seeds_of(ramp(grid, 300), 1, grid);
  const std::vector<GradedSeed> all = graded_cells(*seeds, -6, 6);
  SeedTrees trees;
  Random random(2);
  for (size_t i = 0; i < test_count(200); ++i) {
    trees.move_to(seeds);
    const CellIndex home{static_cast<int32_t>(random.below(5)) - 2,
                         static_cast<int32_t>(random.below(5)) - 2,
                         static_cast<int32_t>(random.below(5)) - 2};
    const Vec3 corner = Vec3{double(home.x), double(home.y), double(home.z)} * seeds->scale();
    const Vec3 q = random.in_box({{}, seeds->scale()});
    const double radius = random.between(0.05, 0.9);
    std::vector<Vec3> expected, found;
    double least = 1e300;
    for (const GradedSeed& seed : all) {
      const Vec3 d = seed.position - corner - q;
      least = std::min(least, dot(d, d));
      if (dot(d, d) <= radius * radius) expected.push_back(seed.position - corner);
    }
    uint64_t order = 0;
    bool ascends = true;
    trees.visit(
        home, Box3{q, q}.grown(radius),
        [&](const Box3& box) { return min_squared(box, q) <= radius * radius; },
        [&](const LeafSeed& seed) {
          ascends = ascends && seed.order > order;
          order = seed.order;
          const Vec3 d = seed.position - q;
          if (dot(d, d) <= radius * radius) found.push_back(seed.position);
        });
    assert_true(ascends);
    assert_int_equal(found.size(), expected.size());
    for (size_t n = 0; n < found.size(); ++n)
      assert_true(max_magnitude(found[n] - expected[n]) < 1e-14);
    double squared = 1e300;
    LeafSeed nearest = trees.at(home, q);
    const Vec3 d = nearest.position - q;
    squared = dot(d, d);
    // A point is within the diagonal of its own leaf of a seed.
    assert_true(squared <= std::ldexp(dot(seeds->scale(), seeds->scale()), -2 * nearest.level));
    trees.nearest(home, q, squared, nearest, [](const LeafSeed&) { return true; });
    assert_true(std::abs(squared - least) < 1e-14);
    assert_true(least <= squared + 1e-14);
  }
}

/// No point of an edge is where its owner's brick would be left out; and bricks are left out.
void test_bricks_left_out_do_not_matter(void**) {
  for (const Neighbourhood& grid : {Neighbourhood{}, turned_grid()})
    for (double high : {20.0, 200.0}) {
      const auto seeds = seeds_of(ramp(grid, high), 1, grid);
      const int side = seeds->brick_side(), bricks = 4 / side;
      Random random(8);
      size_t points = 0, wrong = 0, asked = 0, left_out = 0;
      for (int z = -bricks; z < bricks; ++z)
        for (int y = -bricks; y < bricks; ++y)
          for (int x = -bricks; x < bricks; ++x) {
            const CellIndex corner{x * side, y * side, z * side};
            const Vec3 low =
                Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid.cell_size;
            for (const FoamEdge& e : graded_edge_brick(seeds, corner)->edges())
              for (double t : {0.0, 0.5, 1.0}) {
                const Vec3 a{e.a[0], e.a[1], e.a[2]}, b{e.b[0], e.b[1], e.b[2]};
                const Vec3 v = low + a + (b - a) * t;
                ++points;
                wrong += !seeds->may_own_edges(corner, Box3{v, v}.grown(1e-6));
              }
            for (int i = 0; i < 20; ++i, ++asked) {
              const Vec3 v = low + random.in_box(Box3{}.grown(2)) * grid.cell_size;
              left_out += !seeds->may_own_edges(corner, Box3{v, v}.grown(0.1));
            }
          }
      print_message("ramp to %g: %zu points, %zu wrong; %zu of %zu bricks left out\n", high, points,
                    wrong, left_out, asked);
      assert_int_equal(wrong, 0);
      assert_true(left_out > asked / 8);
    }
}

/// A field that is 1 where it is asked gives, by the refined search, what the plain foam gives.
void test_point_query_of_one_level(void**) {
  const auto make = [](double radius, Parameter density) {
    return make_ref<Foam>(make_ref<Context>(1u, uint64_t{0}, uint64_t{0}), Neighbourhood{},
                          Parameter(radius), 1.0, uint64_t{5}, FoamMethod::direct, density);
  };
  const Parameter far_away(
      Ref<const Field>(make_ref<GradientField>(Vec3{1000, 0, 0}, 1.0, Vec3{1001, 0, 0}, 9.0)));
  Random random(6);
  for (double radius : {0.05, 0.15, 0.4, 0.9}) {
    const Ref<Foam> plain = make(radius, Parameter(1)), graded = make(radius, far_away);
    assert_null(plain->graded().get());
    assert_non_null(graded->graded().get());
    for (size_t i = 0; i < test_count(4000); ++i) {
      Vec3 p = random.in_box(Box3{}.grown(3));
      if (i % 2)
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 8) / 8;
      assert_int_equal(plain->inside(p), graded->inside(p));
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_density_1_is_the_foam),
                              cmocka_unit_test(test_powers_of_8_are_met),
                              cmocka_unit_test(test_constant_density_is_met_on_average),
                              cmocka_unit_test(test_leaves_fill_cells_and_hold_their_seeds),
                              cmocka_unit_test(test_searches),
                              cmocka_unit_test(test_bricks_left_out_do_not_matter),
                              cmocka_unit_test(test_point_query_of_one_level)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
