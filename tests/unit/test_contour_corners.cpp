// SPDX-License-Identifier: Apache-2.0
// Contours of polygons and discs: rings and boundary differ by the tolerance at most, also where a
// corner or an arc reaches into a cell whose four nodes show nothing of it.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/pi.h"
#include "meshes.h"
#include "random.h"
#include "rings.h"
#include "shape/boolean.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "suite.h"

namespace msq::test {

namespace {

using Polygon = std::vector<RingPoint>;

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Polygon regular(RingPoint centre, double radius, uint64_t corners, double turn) {
  Polygon polygon;
  for (uint64_t i = 0; i < corners; ++i) {
    const double angle = turn + 2 * pi * static_cast<double>(i) / static_cast<double>(corners);
    polygon.push_back({centre.u + radius * std::cos(angle), centre.v + radius * std::sin(angle)});
  }
  return polygon;
}

/// From z = -1 to 1.
TriangleSoup prism(const Polygon& polygon) {
  TriangleSoup soup;
  const auto count = static_cast<uint32_t>(polygon.size());
  for (const double z : {-1.0, 1.0})
    for (const RingPoint p : polygon) soup.vertices.push_back({p.u, p.v, z});
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t j = (i + 1) % count;
    soup.triangles.push_back({i, j, count + j});
    soup.triangles.push_back({i, count + j, count + i});
    if (i == 0 || j == 0) continue;
    soup.triangles.push_back({0, j, i});
    soup.triangles.push_back({count, count + i, count + j});
  }
  return soup;
}

Ref<const Shape> mesh_of(const TriangleSoup& soup) {
  return make_ref<Mesh>(soup, WindingRule::nonzero, context()->budget);
}

/// At pitch 1 and z = 0.1, with a window around all.
ContourPlan plan_of(double tolerance) {
  ContourPlan plan;
  plan.plane.height = 0.1;
  plan.pitch = 1;
  plan.tolerance = tolerance;
  plan.has_window = true;
  for (int i = 0; i < 2; ++i) {
    plan.window_min[i] = -12;
    plan.window_max[i] = 12;
  }
  return plan;
}

Rings rings_of(const Ref<const Shape>& shape, const ContourPlan& plan) {
  const Ref<Model> model = make_ref<Model>(context(), shape, std::vector<Model::ScaleParts>{});
  const Ref<Contours> made = layer_contours(*model, plan, nullptr);
  return test::rings_of(reinterpret_cast<const msq_contours*>(made.get()));
}

double distance(RingPoint p, RingPoint a, RingPoint b) {
  const RingPoint d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return std::hypot(p.u - a.u - t * d.u, p.v - a.v - t * d.v);
}

/// From places along the segments of one polygon to another one, the farthest.
double farthest(const Polygon& from, const Polygon& to) {
  double most = 0;
  for (size_t i = 0; i < from.size(); ++i)
    for (int k = 0; k < 8; ++k) {
      const RingPoint a = from[i], d = from[(i + 1) % from.size()] - a;
      const RingPoint p{a.u + d.u * k / 8, a.v + d.v * k / 8};
      double least = HUGE_VAL;
      for (size_t j = 0; j < to.size(); ++j)
        least = std::min(least, distance(p, to[j], to[(j + 1) % to.size()]));
      most = std::max(most, least);
    }
  return most;
}

constexpr double tolerances[] = {0.5, 0.2, 0.1, 0.05, 0.02};

/// Regular polygons of 4 to 24 corners, solid or holes in a box.
void test_polygons(void**) {
  Random random(71);
  for (size_t n = 0; n < test_count(1500); ++n) {
    const RingPoint centre{random.between(-1, 1), random.between(-1, 1)};
    const double radius = random.between(3, 8), turn = random.between(0, 2 * pi);
    const uint64_t corners = 4 + random.below(21);
    const double tolerance = tolerances[random.below(std::size(tolerances))];
    const Polygon polygon = regular(centre, radius, corners, turn);
    const bool is_hole = random.below(2) != 0;
    Ref<const Shape> shape = mesh_of(prism(polygon));
    if (is_hole)
      shape =
          make_ref<BooleanShape>(BooleanShape::Operation::subtracted,
                                 std::vector<Ref<const Shape>>{
                                     make_ref<BoxShape>(Box3{{-15, -15, -1}, {15, 15, 1}}), shape});
    const Rings all = rings_of(shape, plan_of(tolerance));
    check_rings(all);
    const size_t ring = is_hole ? 1 : 0;
    assert_int_equal(all.rings.size(), ring + 1);
    const double off =
        std::max(farthest(polygon, all.rings[ring]), farthest(all.rings[ring], polygon));
    if (!(off <= tolerance))
      fail_msg(
          "%llu corners on a circle of %.9g around (%.9g, %.9g), turned by %.9g, %s: %g "
          "tolerances of %g",
          static_cast<unsigned long long>(corners), radius, centre.u, centre.v, turn,
          is_hole ? "a hole" : "solid", off / tolerance, tolerance);
  }
}

/// Discs as small as 1.6 pitches across.
void test_discs(void**) {
  Random random(72);
  for (size_t n = 0; n < test_count(1500); ++n) {
    const Vec3 centre{random.between(-1, 1), random.between(-1, 1), 0};
    const double radius = random.between(0.8, 4);
    const double tolerance = tolerances[random.below(std::size(tolerances))];
    const Rings all =
        rings_of(make_ref<CylinderShape>(centre - Vec3{0, 0, 1}, centre + Vec3{0, 0, 1}, radius),
                 plan_of(tolerance));
    check_rings(all);
    assert_int_equal(all.rings.size(), 1);
    assert_int_equal(all.unresolved, 0);
    all.for_each_segment([&](RingPoint a, RingPoint b) {
      for (int k = 0; k < 8; ++k) {
        const double u = a.u + (b.u - a.u) * k / 8, v = a.v + (b.v - a.v) * k / 8;
        const double off = std::abs(std::hypot(u - centre.x, v - centre.y) - radius);
        if (!(off <= tolerance))
          fail_msg("disc of %.9g around (%.9g, %.9g): %g tolerances of %g", radius, centre.x,
                   centre.y, off / tolerance, tolerance);
      }
    });
  }
}

/// Two bars that cross, with stubs of 1.1 to 1.6 pitches, solid or a hole in a box. Corners are so
/// near to each other that one may hide another: nearly all are found, and little else is counted.
void test_stubs(void**) {
  Random random(74);
  const size_t count = test_count(1000);
  size_t wrong = 0, doubtful = 0, points = 0;
  for (size_t n = 0; n < count; ++n) {
    const double half = random.between(0.65, 1.5), reach = half + random.between(1.1, 1.6);
    const double turn = random.between(0, pi / 2), c = std::cos(turn), s = std::sin(turn);
    const RingPoint centre{random.between(-1, 1), random.between(-1, 1)};
    const double tolerance = std::array{0.5, 0.25, 0.125, 0.05, 0.02}[random.below(5)];
    Polygon cross;
    for (int side = 0; side < 4; ++side)
      for (const RingPoint p :
           {RingPoint{reach, -half}, RingPoint{reach, half}, RingPoint{half, half}}) {
        RingPoint q = p;
        for (int k = 0; k < side; ++k) q = {-q.v, q.u};
        cross.push_back({centre.u + c * q.u - s * q.v, centre.v + s * q.u + c * q.v});
      }
    const auto bar = [&](int first) {
      const size_t f = static_cast<size_t>(first);
      return mesh_of(prism({cross[f], cross[f + 1], cross[f + 6], cross[f + 7]}));
    };
    std::vector<Ref<const Shape>> bars{bar(0), bar(3)};
    const size_t ring = random.below(2);  // 1: of a hole
    if (ring != 0) bars.insert(bars.begin(), make_ref<BoxShape>(Box3{{-15, -15, -1}, {15, 15, 1}}));
    const auto operation =
        ring != 0 ? BooleanShape::Operation::subtracted : BooleanShape::Operation::united;
    const Rings all = rings_of(make_ref<BooleanShape>(operation, bars), plan_of(tolerance));
    check_rings(all);
    assert_int_equal(all.rings.size(), ring + 1);
    const Polygon& found = all.rings[ring];
    wrong += std::max(farthest(cross, found), farthest(found, cross)) > tolerance;
    doubtful += all.unresolved != 0;
    points += found.size();
  }
  if (wrong > 1 + count / 100) fail_msg("corners of %zu of %zu unions are missed", wrong, count);
  if (doubtful > 1 + count / 100) fail_msg("%zu of %zu unions are counted", doubtful, count);
  if (points > 15 * count) fail_msg("%zu points of %zu unions of 12 corners", points, count);
}

/// The end of an acute gap, between finer nodes: nearly always found or counted.
void test_ends_of_gaps(void**) {
  Random random(75);
  const size_t count = test_count(400);
  size_t missed = 0;
  for (size_t n = 0; n < count; ++n) {
    const double depth = random.between(3, 6), half = depth * std::tan(random.between(0.3, 0.5));
    const double turn = random.between(0, 2 * pi), c = std::cos(turn), s = std::sin(turn);
    const RingPoint end{random.between(-1, 1), random.between(-1, 1)};
    Polygon notched;
    for (const RingPoint p : {RingPoint{0, 0},
                              {depth, half},
                              {depth, half + 3},
                              {-3, half + 3},
                              {-3, -half - 3},
                              {depth, -half - 3},
                              {depth, -half}})
      notched.push_back({end.u + c * p.u - s * p.v, end.v + s * p.u + c * p.v});
    const double tolerance = random.below(2) != 0 ? 0.05 : 0.01;
    const Rings all = rings_of(mesh_of(prism(notched)), plan_of(tolerance));
    check_rings(all);
    if (all.rings.size() != 1) fail_msg("%zu rings around a notch", all.rings.size());
    const double off = std::max(farthest(notched, all.rings[0]), farthest(all.rings[0], notched));
    missed += off > tolerance && all.unresolved == 0;
  }
  if (missed > count / 200) fail_msg("the ends of %zu of %zu gaps are missed", missed, count);
}

/// Where many corners reach into the same cells, rings still touch nothing, also in units so large
/// that rounding moves points by a hundredth of the pitch.
void test_crowds(void**) {
  Random random(73);
  for (size_t n = 0; n < test_count(150); ++n) {
    TriangleSoup soup;
    const uint64_t count = 20 + random.below(60);
    for (uint64_t i = 0; i < count; ++i)
      append(soup,
             prism(regular({random.between(-9, 9), random.between(-9, 9)}, random.between(0.3, 2),
                           3 + random.below(3), random.between(0, 2 * pi))));
    ContourPlan plan = plan_of(tolerances[random.below(std::size(tolerances))]);
    plan.format = ContourFormat::int64;
    plan.units = random.below(2) != 0 ? 200 : 1e6;
    check_rings(rings_of(mesh_of(soup), plan));
  }
}

}  // namespace

}  // namespace msq::test

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(msq::test::test_polygons), cmocka_unit_test(msq::test::test_discs),
      cmocka_unit_test(msq::test::test_stubs), cmocka_unit_test(msq::test::test_ends_of_gaps),
      cmocka_unit_test(msq::test::test_crowds)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
