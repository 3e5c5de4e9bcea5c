// SPDX-License-Identifier: Apache-2.0
// Gaps that become narrower than the pitch: wedges and necks between two discs, and between a disc
// and a wall, are kept down to the tolerance.
#include "slice/contour_gaps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/pi.h"
#include "random.h"
#include "rings.h"
#include "shape/boolean.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "suite.h"

namespace msq::test {

namespace {

constexpr double pitch = 0.0625, radius = 2;

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

double length(RingPoint p) {
  return std::hypot(p.u, p.v);
}

/// A disc, and another disc or a wall beside it. `width`: of the gap where it is narrowest; where
/// both overlap it is negative, and the gap has two tips.
struct Pair {
  RingPoint first, second;
  bool is_wall;

  Pair(RingPoint middle, double angle, double width, bool is_wall)
      : first{middle.u - (radius + 0.5 * width) * std::cos(angle),
              middle.v - (radius + 0.5 * width) * std::sin(angle)},
        second{middle.u + (radius + 0.5 * width) * std::cos(angle),
               middle.v + (radius + 0.5 * width) * std::sin(angle)},
        is_wall(is_wall) {
    if (is_wall) second = {middle.u + 0.5 * width, 0};  // where the wall begins; the angle is 0
  }
  Ref<Model> model() const {
    const Ref<const Shape> ball = make_ref<SphereShape>(Vec3{first.u, first.v, 0}, radius);
    const Ref<const Shape> other =
        is_wall
            ? Ref<const Shape>(make_ref<BoxShape>(Box3{{second.u, -3, -1}, {second.u + 1, 3, 1}}))
            : Ref<const Shape>(make_ref<SphereShape>(Vec3{second.u, second.v, 0}, radius));
    return make_ref<Model>(context(),
                           make_ref<BooleanShape>(BooleanShape::Operation::united,
                                                  std::vector<Ref<const Shape>>{ball, other}),
                           std::vector<Model::ScaleParts>{});
  }
  /// How far a point is from the nearer tip of the gap, if both overlap.
  double from_tip(RingPoint p) const {
    const RingPoint way = is_wall ? RingPoint{second.u - first.u, 0} : second - first;
    const double size = length(way), to_chord = is_wall ? size : 0.5 * size;
    if (to_chord >= radius) return HUGE_VAL;
    const RingPoint along{way.u / size, way.v / size}, d = p - first;
    const double off = std::abs(cross(along, d)) - std::sqrt(radius * radius - to_chord * to_chord);
    return std::hypot(dot(along, d) - to_chord, off);
  }
  /// Distances of a point from both, negative within.
  double from_first(RingPoint p) const { return length(p - first) - radius; }
  double from_second(RingPoint p) const {
    return is_wall ? second.u - p.u : length(p - second) - radius;
  }
};

void test_gap(const Pair& pair, RingPoint middle, double width, double of_pitch, Random& random) {
  ContourPlan plan;
  plan.plane.height = 0;
  plan.pitch = pitch;
  plan.tolerance = of_pitch * pitch;
  plan.topology_samples = 4;
  const Ref<Contours> made = layer_contours(*pair.model(), plan, nullptr);
  const Rings all = rings_of(reinterpret_cast<const msq_contours*>(made.get()));
  check_rings(all);
  // The nodes of divided cells see all that is wider than their diagonal.
  const double wide = 1.5 * plan.tolerance, near = 1.01 * plan.tolerance;
  const auto outer = std::count(all.holes.begin(), all.holes.end(), 0);
  if (width > wide && outer != 2) fail_msg("%g wide, but %d parts", width, static_cast<int>(outer));
  // Else the solid between both tips may be lost.
  if (width < -0.1 * pitch && outer != 1)
    fail_msg("%g deep, but %d parts", -width, static_cast<int>(outer));
  int looked_at = 0;
  for (int n = 0; n < 4000; ++n) {
    const double reach = n % 2 == 0 ? 1.0 : 0.4;
    const RingPoint p{middle.u + reach * random.between(-1, 1),
                      middle.v + reach * random.between(-1, 1)};
    const double a = pair.from_first(p), b = pair.from_second(p), least = std::min(a, b);
    if (std::abs(least) < near || (least > 0 && a + b < wide)) continue;
    if (least > 0 && pair.from_tip(p) < 2.5 * pitch) continue;
    if (pair.is_wall && p.u > pair.second.u + 0.9) continue;
    ++looked_at;
    if (all.winding(p) != (least < 0 ? 1 : 0))
      fail_msg("(%.9g, %.9g) is %.9g and %.9g from both, and on the wrong side", p.u, p.v, a, b);
  }
  assert_true(looked_at > 1000);
}

void test_gaps(void**) {
  Random random(41);
  const int rounds = 20 + static_cast<int>(400 * test_scale());
  for (int round = 0; round < rounds; ++round) {
    const RingPoint middle{random.between(-0.2, 0.2), random.between(-0.2, 0.2)};
    const bool is_wall = round % 4 == 0;
    const double angle = is_wall          ? 0
                         : round % 4 == 1 ? 0.5 * pi * static_cast<double>(random.below(4))
                                          : random.between(-pi, pi);
    // Deep enough overlaps have corners instead of gaps.
    const double width = pitch * random.between(-0.6, 0.9);
    const double of_pitch = random.below(2) == 0 ? 1.0 / 16 : random.between(0.0625, 0.125);
    test_gap(Pair(middle, angle, width, is_wall), middle, width, of_pitch, random);
  }
}

/// Cells are divided by no more than the tolerance and the margin need.
void test_parts(void**) {
  assert_int_equal(gap_parts(1, 1, 1e-6), 1);
  assert_int_equal(gap_parts(1, 0.3, 1e-6), 1);
  assert_int_equal(gap_parts(1, 0.125, 1e-6), 8);
  assert_int_equal(gap_parts(1, 0.1, 1e-6), 10);
  assert_int_equal(gap_parts(1, 1.0 / 16, 1e-6), 16);
  assert_int_equal(gap_parts(1, 0.001, 1e-6), 16);
  assert_int_equal(gap_parts(1, 0.1, 1.0 / 32), 8);
  assert_int_equal(gap_parts(1, 0.1, 1), 1);
}

/// A divided cell has no nodes beyond those that the window's edges leave, so windows that cut
/// through a gap have the same points there.
void test_seam(void**) {
  Random random(5);
  for (int round = 0; round < 40; ++round) {
    const RingPoint middle{random.between(-0.2, 0.2), random.between(-0.2, 0.2)};
    const Pair pair(middle, random.between(-pi, pi), pitch * random.between(0.1, 0.5), false);
    const Ref<Model> model = pair.model();
    ContourPlan plan;
    plan.pitch = pitch;
    plan.tolerance = pitch / 16;
    plan.has_window = true;
    const double cut = middle.u + random.between(-0.1, 0.1);
    std::vector<RingPoint> on_seam[2];
    for (int side = 0; side < 2; ++side) {
      plan.window_min[0] = side == 0 ? -1 : cut;
      plan.window_max[0] = side == 0 ? cut : 1;
      plan.window_min[1] = -1;
      plan.window_max[1] = 1;
      const Ref<Contours> made = layer_contours(*model, plan, nullptr);
      const Rings all = rings_of(reinterpret_cast<const msq_contours*>(made.get()));
      check_rings(all);
      for (const auto& ring : all.rings)
        for (const RingPoint p : ring)
          if (p.u == cut) on_seam[side].push_back(p);
      std::sort(on_seam[side].begin(), on_seam[side].end());
    }
    assert_true(on_seam[0] == on_seam[1]);
  }
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  const CMUnitTest tests[] = {cmocka_unit_test(test_gaps), cmocka_unit_test(test_parts),
                              cmocka_unit_test(test_seam)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
