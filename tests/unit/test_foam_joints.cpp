// SPDX-License-Identifier: Apache-2.0
// The struts of foams whose seeds are almost at the centres of their cells, so that eight and more
// are almost on one sphere, and of others: each comes once, wherever boxes are cut; nodes are as
// far from four seeds as double precision can tell, and as near as any seed; and where it tells
// four seeds from others, four struts meet.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "msq_test.h"
#include "structure/common/struts.h"
#include "structure/foam/foam.h"
#include "structure/foam/joints/exact_seeds.h"
#include "structure/foam/joints/named_seeds.h"
#include "structure/foam/seeds/period_seeds.h"

using namespace msq;

namespace {

struct Kind {
  const char* name;
  Vec3 cell_size = {1, 1, 1};
  Vec3 stretch = {1, 1, 1};
  double weight = 0, density = 1;
  bool has_period = false;
};

constexpr Kind kinds[] = {
    {"plain"},
    {"cells of three sides", {1, 0.7, 0.9}},
    {"stretched", {1, 1, 1}, {2.1, 0.8, 1}},
    {"weighted", {1, 1, 1}, {1, 1, 1}, 0.3},
    {"weighted slightly", {1, 1, 1}, {1, 1, 1}, 1e-6},
    {"period", {1, 1, 1}, {1, 1, 1}, 0, 1, true},
    {"density 5", {1, 1, 1}, {1, 1, 1}, 0, 5},
    {"density 8", {1, 1, 1}, {1, 1, 1}, 0, 8},
};

Ref<const Foam> make_foam(const Kind& kind, double jitter) {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  Neighbourhood grid{{}, kind.cell_size, {}};
  std::shared_ptr<const PlacedSeeds> placed;
  if (kind.has_period) {
    placed = std::make_shared<const PeriodSeeds>(
        grid, GradedPeriod(0, {{0, 1}, {4, 0.6}, {8, 1.2}}), jitter, uint64_t{7});
    grid = placed->grid();
  }
  return make_ref<Foam>(context, grid, Parameter(0.05), jitter, uint64_t{7}, FoamMethod::automatic,
                        Parameter(kind.density), kind.stretch, kind.weight, placed);
}

std::vector<Strut> struts_of(const Structure& foam, const Box3& box) {
  const std::unique_ptr<StrutParts> parts = foam.struts({box, true});
  StrutList list;
  for (uint64_t i = 0; i < parts->count(); ++i) parts->append(i, list);
  std::sort(list.struts.begin(), list.struts.end(),
            [](const Strut& a, const Strut& b) { return a.id < b.id; });
  return list.struts;
}

/// How many seeds are farther from a point than the nearest one by at most `more`.
size_t seeds_near(const Foam& foam, NamedSeeds& seeds, Vec3 p, double more) {
  const Vec3 scale = foam.diagram_seeds().scale();
  const Vec3 q = foam.to_diagram(foam.neighbourhood().to_grid(p) * (1 / foam.unit()));
  const Vec3 cell{std::floor(q.x / scale.x), std::floor(q.y / scale.y), std::floor(q.z / scale.z)};
  seeds.move_to(foam.diagram_seeds(), foam.graded(),
                {int32_t(cell.x), int32_t(cell.y), int32_t(cell.z)}, 1);
  std::vector<NamedSeed> near;
  seeds.find(q - cell * scale, more, near);
  return near.size();
}

void check(const Kind& kind, double jitter) {
  const auto fail = [&](const char* what) {
    fail_msg("%s, jitter %g: %s", kind.name, jitter, what);
  };
  const Ref<const Foam> foam = make_foam(kind, jitter);
  // Bricks of 8 cells begin 2 cells before multiples of 8, smaller ones at multiples of their side.
  const double half = kind.density > 1 ? 0.9 : 1.4;
  const Vec3 middle = kind.density > 1 ? Vec3{4.1, 2.2, 1.9} : Vec3{6.1, 2.2, 1.9};
  const Box3 box{middle - Vec3{half, half, half}, middle + Vec3{half, half, half}};
  const std::vector<Strut> whole = struts_of(*foam, box);
  if (whole.size() < 40) fail("struts are missing");
  for (size_t i = 1; i < whole.size(); ++i)
    if (whole[i - 1].id == whole[i].id) fail("a strut comes twice");

  Box3 low = box, high = box;
  low.max.x = high.min.x = middle.x - 0.21;
  std::vector<Strut> all = struts_of(*foam, low);
  const std::vector<Strut> rest = struts_of(*foam, high);
  all.insert(all.end(), rest.begin(), rest.end());
  std::sort(all.begin(), all.end(), [](const Strut& a, const Strut& b) { return a.id < b.id; });
  if (all.size() != whole.size() ||
      std::memcmp(all.data(), whole.data(), all.size() * sizeof(Strut)) != 0)
    fail("the struts of two halves are others");

  struct Node {
    Vec3 at;
    size_t struts = 0;
  };
  std::map<Id, Node> nodes;
  for (const Strut& s : whole)
    for (int end = 0; end < 2; ++end) {
      const Vec3 at = end ? s.b : s.a;
      Node& node = nodes.insert({s.nodes[end], {at}}).first->second;
      ++node.struts;
      if (!(node.at == at)) fail("a node is at two places");
    }
  NamedSeeds seeds;
  for (const auto& [id, node] : nodes) {
    if (seeds_near(*foam, seeds, node.at, 2e-12) < 4) fail("a node is not equally far from four");
    // All struts of nodes in the middle are among them: in these, half a strut is shorter.
    if (max_magnitude(node.at - middle) > 0.4 * half) continue;
    if (node.struts < 4) fail("fewer than four struts meet");
    if (node.struts > 4 && seeds_near(*foam, seeds, node.at, 1e-9) == 4)
      fail("more than four struts meet");
  }
}

void struts_come_once_at_any_jitter(void**) {
  const double jitters[] = {0, 1e-14, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-1, 1};
  size_t number = 0;
  for (const Kind& kind : kinds)
    for (const double jitter : jitters)
      if (number++ % 4 == 0 || test_scale() >= 1) check(kind, jitter);
}

ExactSeeds::Seed seed_at(double x, double y, double z, double lift = 0) {
  return ExactSeeds::from({5, -3, 2}, {{5, -3, 2}, 0, {x, y, z}, lift});
}

void seeds_are_compared_exactly(void**) {
  for (const Vec3 scale : {Vec3{1, 1, 1}, Vec3{1, 0.7, 0.3}, Vec3{0.0625, 1, 1 / 3.0}}) {
    const ExactSeeds exact(scale);
    const ExactSeeds::Seed a = seed_at(0.5, 0.5, 0.5), b = seed_at(1.5, 0.5, 0.5),
                           c = seed_at(0.5, 1.5, 0.5), d = seed_at(0.5, 0.5, 1.5),
                           e = seed_at(1.5, 1.5, 1.5), f = seed_at(1.5, 1.5, 0.5);
    assert_int_equal(exact.side(a, b, c, d), 1);
    assert_int_equal(exact.side(a, c, b, d), -1);
    assert_int_equal(exact.side(a, b, c, f), 0);
    assert_int_equal(exact.side(a, b, c, seed_at(1.5, 1.5, 0.5 + 0x1p-40)), 1);
    assert_int_equal(exact.side(a, b, c, seed_at(1.5, 1.5, 0.5 - 0x1p-40)), -1);
    assert_int_equal(exact.nearer(a, b, c, d, e), 0);
    assert_int_equal(exact.nearer(a, c, b, d, e), 0);
    for (const double sign : {1.0, -1.0}) {
      const int nearer = sign > 0 ? -1 : 1;
      assert_int_equal(exact.nearer(a, b, c, d, seed_at(1.5 + sign * 0x1p-40, 1.5, 1.5)), nearer);
      assert_int_equal(exact.nearer(a, c, b, d, seed_at(1.5, 1.5 + sign * 0x1p-40, 1.5)), nearer);
      assert_int_equal(exact.nearer(a, b, c, d, seed_at(0.5, 1.5, 1.5 + sign * 0x1p-40)), nearer);
    }
    assert_int_equal(exact.nearer(a, b, c, d, seed_at(1.5, 1.5, 1.5, 1e-30)), -1);
    // That moves the point by as much as half the lift along each axis, away from e.
    assert_int_equal(exact.nearer(seed_at(0.5, 0.5, 0.5, 1e-30), b, c, d, e), -1);
    const Vec3 centre = exact.centre(a, b, c, d);
    assert_true(max_magnitude(centre - scale * 0.5) < 1e-15);
    // Almost in a plane.
    const ExactSeeds::Seed g = seed_at(1.5 - 0x1p-20, 1.5, 0.5 + 0x1p-20);
    const Vec3 far = exact.centre(a, b, c, g);
    for (const ExactSeeds::Seed& seed : {b, c, g}) {
      const Vec3 to = exact.apart(a, seed) - far;
      assert_true(std::abs(length(to) / length(far) - 1) < 1e-14);
    }
  }
}

/// Seeds in a plane and on a sphere, where doubles give a sign of their rounding.
void signs_are_not_those_of_rounding(void**) {
  constexpr int64_t cell = int64_t{1} << 40;
  std::mt19937_64 random(1);
  const auto number = [&] { return static_cast<int64_t>(random() % cell); };
  for (int i = 0; i < 1000; ++i) {
    const ExactSeeds exact({1, 0.7, 1 / (1 + 0x3p-40 * double(number()))});
    const ExactSeeds::Seed a{{number(), number(), number()}, 0},
        b{{number(), number(), number()}, 0}, c{{number(), number(), number()}, 0};
    ExactSeeds::Seed d{{}, 0};
    for (int axis = 0; axis < 3; ++axis) d.m[axis] = b.m[axis] + 3 * (c.m[axis] - a.m[axis]);
    assert_int_equal(exact.side(a, b, c, d), 0);
    // Corners of a box.
    const int64_t x = 1 + number(), y = 1 + number(), z = 1 + number();
    const ExactSeeds::Seed p{{a.m[0] + x, a.m[1], a.m[2]}, 0}, q{{a.m[0], a.m[1] + y, a.m[2]}, 0},
        r{{a.m[0], a.m[1], a.m[2] + z}, 0};
    ExactSeeds::Seed e{{a.m[0] + x, a.m[1] + y, a.m[2] + z}, 0};
    assert_int_equal(exact.nearer(a, p, q, r, e), 0);
    ++e.m[i % 3];
    assert_int_equal(exact.nearer(a, p, q, r, e), -1);
    assert_int_equal(exact.nearer(a, q, p, r, e), -1);
    e.m[i % 3] -= 2;
    assert_int_equal(exact.nearer(a, p, q, r, e), 1);
    assert_int_equal(exact.nearer(a, q, p, r, e), 1);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(seeds_are_compared_exactly),
      cmocka_unit_test(signs_are_not_those_of_rounding),
      cmocka_unit_test(struts_come_once_at_any_jitter),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
