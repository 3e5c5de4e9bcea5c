// SPDX-License-Identifier: Apache-2.0
// Rays through foams in packets and each alone: the same bits.
#include <vector>

#include "field/radial.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/foam/rays/packets.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  double jitter, radius;
  Vec3 cell_size;
  bool is_graded, is_dense;
  double away = 0;  ///< of the grid's origin
};
constexpr Row rows[] = {
    {"common", 1, 0.1, {1, 1, 1}, false, false},
    {"thin", 1, 1e-3, {1, 1, 1}, false, false},
    {"as thick as may be", 1, 1, {1, 1, 1}, false, false},
    {"no jitter", 0, 0.07, {0.6, 0.5, 1}, false, false},
    {"graded", 1, 0.1, {1, 1, 1}, true, false},
    {"dense, no jitter", 0, 0.127, {1.6549, 1.1042, 3.9335}, true, true},
    // Rounding may hide the strut in which a ray begins.
    {"far from the origin", 1, 0.2, {1, 1, 1}, false, false, 1e5},
};

Parameter radius_of(const Row& row) {
  if (!row.is_graded) return Parameter(row.radius);
  const RadialField::Ramp ramp{1.2, row.radius, 10, 0.6 * row.radius};
  return Parameter(make_ref<RadialField>(Vec3{0.3, -0.2, 0.1}, Vec3{}, ramp));
}

Parameter density_of(const Row& row) {
  if (!row.is_dense) return Parameter(1);
  return Parameter(make_ref<RadialField>(Vec3{}, Vec3{}, RadialField::Ramp{1.2, 20, 10, 1}));
}

/// Next to each other, some no longer than a point. Long tiles may jump by some cells now and then,
/// so that packets end at any ray.
std::vector<RaySearch> tile(const Row& row, Random& random) {
  const Vec3 start = random.in_box({{-3, -3, -3}, {3, 3, 3}});
  Vec3 way{random.normal(), random.normal(), random.normal()};
  if (random.below(2) == 0) way[static_cast<int>(random.below(3))] = 0;
  const Vec3 across{random.normal(), random.normal(), random.normal()};
  const double spread = random.below(2) == 0 ? 0.02 : 1e-4;
  std::vector<RaySearch> searches(random.below(2) == 0 ? 50 : 16);
  const bool jumps = searches.size() > 16 && random.below(4) != 0;
  Vec3 jumped;
  uint64_t until_jump = random.below(16);
  for (RaySearch& s : searches) {
    const auto n = static_cast<double>(&s - searches.data());
    if (jumps && until_jump-- == 0) {
      jumped = random.in_box({{-2, -2, -2}, {2, 2, 2}});
      until_jump = random.below(16);
    }
    s.ray = {start + jumped + across * (spread * n), way * (1 / length(way))};
    s.from = random.below(4) == 0 ? random.unit() : 0;
    s.to = random.below(8) == 0 ? s.from : s.from + 4 * max_component(row.cell_size);
  }
  return searches;
}

void finds_the_same(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(3);
  const auto context = make_ref<Context>(1u, uint64_t{1} << 26, uint64_t{0});
  const Neighbourhood grid{{0.3 + row.away, -0.2, 0.1}, row.cell_size, {}};
  const auto foam = make_ref<Foam>(context, grid, radius_of(row), row.jitter, uint64_t{3},
                                   FoamMethod::direct, density_of(row));
  size_t found = 0;
  for (size_t n = 0; n < test_count(row.is_dense ? 100 : 200); ++n) {
    std::vector<RaySearch> together = tile(row, random), alone = together;
    assert_true(walk_cells(*foam, together.data(), together.size(), nullptr));
    for (size_t i = 0; i < alone.size(); ++i) {
      const RaySearch &a = together[i], &b = alone[i];
      walk_cells(*foam, &alone[i], 1, nullptr);
      found += b.found;
      if (a.found != b.found || (a.found && !(a.t == b.t && a.normal == b.normal)))
        fail_msg("ray %zu of tile %zu, from %.17g to %.17g: %d %.17g, alone %d %.17g", i, n, a.from,
                 a.to, a.found, a.t, b.found, b.t);
    }
  }
  assert_true(found > 0 || row.radius < 0.01);
}

}  // namespace

int main() {
  std::vector<CMUnitTest> tests;
  for (const Row& row : rows)
    tests.push_back({row.name, finds_the_same, nullptr, nullptr, const_cast<Row*>(&row)});
  return _cmocka_run_group_tests("ray_packets", tests.data(), tests.size(), nullptr, nullptr);
}
