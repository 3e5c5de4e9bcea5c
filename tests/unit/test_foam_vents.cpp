// SPDX-License-Identifier: Apache-2.0
// Holes through the walls of closed-cell foams. tests/unit/test_foam_walls_voropp.cpp compares
// their definition with voro++.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "cell/context.h"
#include "field/gradient.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/walls/foam_walls.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Context> context() {
  static const Ref<Context> made = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return made;
}

Ref<FoamWalls> make_walls(double thickness, double vent_radius, double jitter = 1,
                          const Neighbourhood& grid = {}) {
  return make_ref<FoamWalls>(context(), grid, Parameter(thickness), jitter, uint64_t{3},
                             Parameter(1), Parameter(vent_radius));
}

/// Seeds at the centres of cells: holes are circles about the middles of the grid's faces.
void test_without_jitter(void**) {
  // A circle with more area than a face, of radius above 0.5642, makes no hole.
  for (const double radius : {0.2, 0.5, 0.56, 0.57}) {
    const auto walls = make_walls(0.2, radius, 0);
    Random random(5);
    size_t holes = 0;
    for (size_t i = 0; i < test_count(20000); ++i) {
      const Vec3 p = random.in_box({{-2, -2, -2}, {2, 2, 2}});
      double onset = 10;
      bool is_near = false;
      for (int axis = 0; axis < 3; ++axis) {
        const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
        const double from_axis = std::hypot(u - std::floor(u) - 0.5, v - std::floor(v) - 0.5);
        const double twice = 2 * std::abs(p[axis] - std::round(p[axis]));
        is_near = is_near || std::abs(from_axis - radius) < 1e-7;
        if (radius > 0.565 || from_axis >= radius)
          onset = std::min(onset, twice);
        else
          holes += twice <= 0.2;
      }
      if (is_near) continue;
      // Walls across the cell are farther than the limit of the parameter.
      if (onset < 1) assert_true(std::abs(walls->onset(p) - onset) <= 1e-14);
      if (std::abs(onset - 0.2) > 1e-12) assert_int_equal(walls->inside(p), onset < 0.2);
    }
    assert_true((holes > 0) == (radius < 0.565));
  }
}

/// Beyond the limit of the thickness no wall is sought.
void test_onsets_end_at_the_limit(void**) {
  for (const double jitter : {0.0, 1.0}) {
    const auto walls = make_walls(0.2, 0.45, jitter);
    Random random(6);
    size_t known = 0;
    for (size_t i = 0; i < test_count(5000); ++i) {
      const double onset = walls->onset(random.in_box({{-2, -2, -2}, {2, 2, 2}}));
      known += onset <= walls->onset_limit();
      assert_true(onset <= walls->onset_limit() * (1 + 1e-8) || std::isinf(onset));
    }
    assert_true(known > 0);
  }
}

/// The components of the void of a cube of cells, sampled.
class VoidComponents {
 public:
  static constexpr int cells = 6, per_cell = 20, n = cells * per_cell;

  explicit VoidComponents(const FoamWalls& walls) : parent_(size_t{n} * n * n) {
    std::vector<uint64_t> bits(size_t{words} * n * n);
    for (size_t row = 0; row < size_t{n} * n; ++row) set_bits(&bits[row * words], 0, n - 1);
    const double step = 1.0 / per_cell;
    const SampleGrid grid{{0.5 * step, 0.5 * step, 0.5 * step}, {step, step, step}, n, n, n};
    const RowBlock block{&grid, 0, n, 0, n, bits.data(), words, words * n};
    walls.keep_rows(block, nullptr);
    std::iota(parent_.begin(), parent_.end(), uint32_t{0});
    const auto is_void = [&](int x, int y, int z) {
      return !(bits[(size_t(z) * n + size_t(y)) * words + size_t(x) / 64] >> (x % 64) & 1);
    };
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          if (!is_void(x, y, z)) {
            parent_[index(x, y, z)] = solid;
            continue;
          }
          if (x > 0) join(index(x, y, z), index(x - 1, y, z));
          if (y > 0) join(index(x, y, z), index(x, y - 1, z));
          if (z > 0) join(index(x, y, z), index(x, y, z - 1));
        }
  }

  static constexpr uint32_t solid = 0xffffffff;
  /// Of the sample nearest to a point.
  uint32_t at(Vec3 p) {
    const auto sample = [](double x) { return static_cast<int>(x * per_cell); };
    const size_t i = index(sample(p.x), sample(p.y), sample(p.z));
    return parent_[i] == solid ? solid : root(static_cast<uint32_t>(i));
  }

 private:
  static constexpr size_t words = (n + 63) / 64;
  static size_t index(int x, int y, int z) {
    return (static_cast<size_t>(z) * n + static_cast<size_t>(y)) * n + static_cast<size_t>(x);
  }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(size_t a, size_t b) {
    if (parent_[b] == solid) return;
    parent_[root(static_cast<uint32_t>(a))] = root(static_cast<uint32_t>(b));
  }

  std::vector<uint32_t> parent_;
};

/// Without holes each cell is a void of its own. With them, those of all cells within a box are
/// one.
void test_void_is_connected_by_holes(void**) {
  for (const double radius : {0.0, 0.15}) {
    const auto walls = make_walls(0.1, radius);
    VoidComponents components(*walls);
    std::vector<uint32_t> found;
    const FoamSeeds& seeds = walls->seeds().seeds();
    // Cells at the border of the box may be joined beyond it.
    for (int z = 1; z < VoidComponents::cells - 1; ++z)
      for (int y = 1; y < VoidComponents::cells - 1; ++y)
        for (int x = 1; x < VoidComponents::cells - 1; ++x) {
          const uint32_t component = components.at(seeds.at({0, 0, 0}, x, y, z));
          if (component != VoidComponents::solid) found.push_back(component);
        }
    const size_t count = found.size();
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    print_message("holes of %g: %zu voids in %zu cells\n", radius, found.size(), count);
    assert_true(count > 50);
    assert_int_equal(found.size(), radius > 0 ? 1 : count);
  }
}

/// Rows of samples are the same bits as points, one row in `every` of them. Returns how many
/// samples holes open.
size_t check_rows(const FoamWalls& walls, const FoamWalls& plain, const SampleGrid& samples,
                  uint64_t every) {
  const uint64_t n = samples.ny, layers = samples.nz;
  assert_true(samples.nx == 64);
  std::vector<uint64_t> bits(n * layers, ~uint64_t{0}), plain_bits = bits;
  RowBlock block{&samples, 0, n, 0, layers, bits.data(), 1, n};
  walls.keep_rows(block, nullptr);
  block.words = plain_bits.data();
  plain.keep_rows(block, nullptr);
  size_t opened = 0;
  Random random(8);
  for (uint64_t k = 0; k < layers; ++k)
    for (uint64_t j = 0; j < n; ++j) {
      const uint64_t row = bits[k * n + j], plain_row = plain_bits[k * n + j];
      assert_true((row & ~plain_row) == 0);
      opened += static_cast<size_t>(__builtin_popcountll(plain_row & ~row));
      if (random.below(every) != 0) continue;
      for (uint64_t i = 0; i < 64; ++i)
        assert_int_equal(row >> i & 1, walls.inside(samples.at(i, j, k)));
    }
  return opened;
}

void test_rows_agree_with_points(void**) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Rotation turned{{c, -s, 0, s, c, 0, 0, 0, 1}};
  const Neighbourhood grids[] = {{}, {{0.3, 0.2, -0.7}, {1, 0.8, 0.5}, turned}};
  struct Case {
    double thickness, radius, jitter;
  };
  const Case cases[] = {{0.1, 0.15, 1}, {0.05, 0.4, 1}, {0.4, 0.3, 1},
                        {0.1, 0.01, 1}, {0.1, 0.3, 0},  {0.1, 0.45, 0.01}};
  for (const Neighbourhood& grid : grids)
    for (const Case& size : cases) {
      const double cell = min_component(grid.cell_size);
      const auto walls = make_walls(size.thickness * cell, size.radius * cell, size.jitter, grid);
      const auto plain = make_walls(size.thickness * cell, 0, size.jitter, grid);
      const double step = 1.0 / 23.7;
      const SampleGrid samples{{-0.7, 0.4, 1.1}, {step, step * 0.9, step * 1.1}, 64, 64, 24};
      const size_t opened = check_rows(*walls, *plain, samples, 4);
      print_message("thickness %g, holes of %g, jitter %g: %zu samples opened\n", size.thickness,
                    size.radius, size.jitter, opened);
      assert_true(opened > 0 || size.radius < 0.1);
    }
}

/// The same of seeds in octrees and in warped cells: faces of unlike sizes.
void test_rows_of_uneven_seeds_agree_with_points(void**) {
  const Ref<const Field> gradient = make_ref<GradientField>(Vec3{0, 0, 0}, 1, Vec3{2, 0, 0}, 12);
  const auto placed = std::make_shared<const WarpSeeds>(
      context(), Warp{Warp::Kind::cylindrical, Neighbourhood{}, {12, 0, 0.8, 2.6}}, 1.0,
      uint64_t{3});
  for (const bool is_warped : {false, true}) {
    const auto make = [&](double vent_radius) {
      return make_ref<FoamWalls>(context(), Neighbourhood{}, Parameter(0.06), 1.0, uint64_t{3},
                                 is_warped ? Parameter(1) : Parameter(gradient),
                                 Parameter(vent_radius), Vec3{1, 1, 1}, 0.0,
                                 is_warped ? placed : nullptr);
    };
    const double step = 1.0 / 40.3;
    const SampleGrid samples{{0.5, 0.4, 0.3}, {step, step, step}, 64, 64, 48};
    assert_true(check_rows(*make(0.12), *make(0), samples, 1) > 100);
  }
}

/// Steps of the bound from a point never change membership, and bounds of near points agree.
void test_distances_are_safe(void**) {
  const Neighbourhood grid{{}, {1, 0.8, 1.2}, {}};
  const Parameter radius(
      Ref<const Field>(make_ref<GradientField>(Vec3{-2, 0, 0}, 0.05, Vec3{2, 0, 0}, 0.3)));
  const FoamWalls walls(context(), grid, Parameter(0.1), 1, 3, Parameter(1), radius);
  Random random(6);
  size_t zero = 0, asked = 0;
  for (size_t i = 0; i < test_count(3000); ++i) {
    const Vec3 p = random.in_box({{-2, -2, -2}, {2, 2, 2}});
    const bool is_inside = walls.inside(p);
    const double bound = walls.distance_bound(p);
    ++asked;
    zero += bound == 0;
    for (int k = 0; k < 6; ++k) {
      Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
      d = d * (1 / length(d));
      assert_int_equal(walls.inside(p + d * (bound * random.between(0, 1))), is_inside);
      const double step = random.between(0, 0.1);
      assert_true(std::abs(walls.distance_bound(p + d * step) - bound) <= step + 1e-6);
    }
  }
  print_message("%zu bounds, %zu of them 0\n", asked, zero);
  assert_true(zero < asked / 10);
}

/// Rays go through holes, and meet walls where steps of the distance do: `count` rays in cells
/// about the origin. Parts of a ray that are shorter than the tolerance may be lost.
void check_rays(const FoamWalls& walls, const FoamWalls& plain, size_t count) {
  const Vec3 size = walls.neighbourhood().cell_size;
  Random random(4);
  size_t passed = 0, met = 0;
  double worst = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3 direction = random.in_box({{-1, -1, -1}, {1, 1, 1}}) * size;
    if (i % 4 == 0)
      for (int axis = 0; axis < 3; ++axis) direction[axis] = static_cast<int>(i / 4 % 3) == axis;
    direction = direction * (1 / length(direction));
    RaySearch search;
    search.ray = {random.in_box({{-3, -3, -3}, {3, 3, 3}}) * size, direction};
    search.to = 6;
    RaySearch marched = search, whole = search;
    walls.enter(&search, 1, nullptr);
    walls.Structure::enter(&marched, 1, nullptr);
    plain.enter(&whole, 1, nullptr);
    assert_int_equal(search.found, marched.found);
    if (!search.found) continue;
    ++met;
    worst = std::max(worst, std::abs(search.t - marched.t));
    assert_true(walls.inside(search.ray.at(search.t)));
    if (search.t > 0) {
      const Vec3 n = walls.normal(search.ray, search.t);
      assert_true(std::abs(length(n) - 1) < 1e-12 && dot(n, direction) <= 0);
    }
    passed += whole.found && whole.t + 1e-3 < search.t;
  }
  print_message("%zu rays met walls, %zu through holes; apart by %g at most\n", met, passed, worst);
  assert_true(worst <= 2 * walls.ray_tolerance() && met > passed && passed > 0);
}

void test_rays_go_through_holes(void**) {
  const auto walls = make_walls(0.1, 0.2), plain = make_walls(0.1, 0);
  check_rays(*walls, *plain, test_count(500));
  assert_true(walls->thin_walls() == ThinWalls::uniform &&
              plain->thin_walls() == ThinWalls::uniform);
}

/// The same in flat and long cells of several seeds, and where the thickness has a slope.
void test_rays_go_through_holes_of_uneven_cells(void**) {
  const Parameter slope(
      Ref<const Field>(make_ref<GradientField>(Vec3{-1, -2, 0}, 0.02, Vec3{2, 1, 0}, 0.09)));
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{0.25, 0.25, 1}, Vec3{0.25, 1, 1}})
    for (const double density : {1.0, 8.0})
      for (const Parameter& thickness : {Parameter(0.03), slope}) {
        const auto make = [&](double radius) {
          return make_ref<FoamWalls>(context(), Neighbourhood{{}, size, {}}, thickness, 1.0,
                                     uint64_t{3}, Parameter(density), Parameter(radius));
        };
        check_rays(*make(0.08), *make(0), std::max(size_t{40}, test_count(80)));
      }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_without_jitter),
                              cmocka_unit_test(test_onsets_end_at_the_limit),
                              cmocka_unit_test(test_void_is_connected_by_holes),
                              cmocka_unit_test(test_rows_agree_with_points),
                              cmocka_unit_test(test_rows_of_uneven_seeds_agree_with_points),
                              cmocka_unit_test(test_distances_are_safe),
                              cmocka_unit_test(test_rays_go_through_holes),
                              cmocka_unit_test(test_rays_go_through_holes_of_uneven_cells)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
