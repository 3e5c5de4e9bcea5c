// SPDX-License-Identifier: Apache-2.0
// Searches in a tree of triangles against all triangles one by one, to the last bit, with every
// instruction set: distances, nearest triangles, ranges, and crossings of rays.
#include "shape/triangle_search.h"
#include "shape/triangle_tree.h"

#include <hwy/targets.h>

#include <cmath>
#include <cstring>

#include "base/unit.h"
#include "meshes.h"
#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  std::vector<TreeTriangle> triangles;
  double size = 1;  ///< of the box of points
};

std::vector<TreeTriangle> triangles_of(const TriangleSoup& soup, double scale, Vec3 offset) {
  std::vector<TreeTriangle> triangles;
  const auto vertex = [&](uint32_t i) { return soup.vertices[i] * scale + offset; };
  for (const Triangle& t : soup.triangles)
    triangles.emplace_back(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return triangles;
}

/// Of any size up to this, with every kind of degenerate triangle if wanted.
std::vector<TreeTriangle> scattered(size_t count, double size, bool degenerate, uint64_t seed) {
  Random random(seed);
  const Box3 cube{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  std::vector<TreeTriangle> triangles;
  while (triangles.size() < count) {
    const Vec3 a = random.in_box(cube), b = a + random.in_box(cube) * size;
    Vec3 c = a + random.in_box(cube) * size;
    if (degenerate) {
      const double along = random.between(-0.5, 1.5);
      const Vec3 on = a + (b - a) * along;
      const size_t kind = triangles.size() % 6;
      if (kind == 0) c = a;
      if (kind == 1) c = on;
      if (kind == 2) c = on + (c - a) * std::pow(10.0, random.between(-16, -3));
      if (kind == 3) {
        triangles.emplace_back(a, a, a);
        continue;
      }
    }
    triangles.emplace_back(a, b, c);
  }
  return triangles;
}

/// Flat, with vertices that six triangles share: many are equally far.
std::vector<TreeTriangle> flat_net(int side) {
  std::vector<TreeTriangle> triangles;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = 1.0 * i / side - 0.5, y = 1.0 * j / side - 0.5, h = 1.0 / side;
      triangles.emplace_back(Vec3{x, y, 0}, Vec3{x + h, y, 0}, Vec3{x + h, y + h, 0});
      triangles.emplace_back(Vec3{x, y, 0}, Vec3{x + h, y + h, 0}, Vec3{x, y + h, 0});
    }
  return triangles;
}

std::vector<Row> rows() {
  std::vector<Row> rows;
  for (const size_t count : std::initializer_list<size_t>{1, 2, 7, 8, 9, 64, 65, 72, 513})
    rows.push_back({"scattered, " + std::to_string(count), scattered(count, 0.2, false, count)});
  rows.push_back({"large", scattered(150, 2, false, 1)});
  rows.push_back({"degenerate", scattered(300, 0.3, true, 2)});
  rows.push_back({"points", scattered(40, 0, false, 3)});
  rows.push_back({"flat net", flat_net(12)});
  rows.push_back({"torus", triangles_of(torus_mesh(0.375, 0.125, 24, 12), 1, {})});
  rows.push_back({"ball, off", triangles_of(icosphere(0.5, 2), 1, {1000, -300, 7})});
  rows.push_back({"ball, far off", triangles_of(icosphere(0.5, 2), 1, {1e6, 2e6, -3e6})});
  rows.push_back({"small ball", triangles_of(icosphere(0.5, 2), 1e-6, {}), 1e-6});
  std::vector<TreeTriangle> twice = flat_net(6), same = twice;
  twice.insert(twice.end(), same.begin(), same.end());
  rows.push_back({"all twice", std::move(twice)});
  rows.push_back(
      {"all the same", std::vector(200, TreeTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}))});
  return rows;
}

Vec3 some_point(Random& random, const Row& row, size_t i) {
  const TreeTriangle& t = row.triangles[random.below(row.triangles.size())];
  const Vec3 by = random.in_box({{-1, -1, -1}, {1, 1, 1}}) * row.size;
  const double s = random.unit(), r = random.unit() * (1 - s);
  switch (i % 8) {
    case 0:
      return t.a;
    case 1:
      return t.a + (i % 16 < 8 ? t.u : t.v);
    case 2:
      return t.a + (t.u + t.v) * 0.5;
    case 3:
      return t.a + t.u * s + t.v * r;
    case 4:
      return t.a + by * std::pow(10.0, random.between(-15, -1));
    case 5:
      return t.a + by * std::pow(10.0, random.between(0, 12));
    case 6:
      return t.a + cross(t.u, t.v) * s;
    default:
      return t.a + by;
  }
}

double least_squared(const Row& row, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const TreeTriangle& t : row.triangles) least = std::min(least, t.distance_squared(p));
  return least;
}

void check_point(const Row& row, const TriangleTree& tree, Vec3 p, uint32_t other) {
  const double squared = least_squared(row, p), distance = std::sqrt(squared);
  const double got = tree.distance(p);
  if (std::memcmp(&got, &distance, sizeof got) != 0)
    fail_msg("(%.17g, %.17g, %.17g): %.17g, not %.17g", p.x, p.y, p.z, got, distance);
  const TriangleTree::Nearest nearest = tree.nearest(p, 0);
  assert_memory_equal(&nearest.distance, &distance, sizeof distance);
  for (const uint32_t start : {other, nearest.triangle}) {
    const TriangleTree::Nearest again = tree.nearest(p, start);
    assert_memory_equal(&again.distance, &distance, sizeof distance);
    assert_int_equal(again.triangle, nearest.triangle);
    assert_true(again.point == nearest.point);
  }
  const double at_foot = length(p - nearest.point);
  if (!(std::abs(at_foot - distance) <= 1e-12 * (distance + max_magnitude(p)) + 4 * tree.excess()))
    fail_msg("foot at %.17g, not %.17g", at_foot, distance);
  for (const double low : {0.0, 0.5 * distance, distance, distance * (1 + 0x1p-40), 2 * distance})
    for (const double high : {low, low * (1 + 0x1p-30), low + distance}) {
      const TriangleTree::Range wanted = squared < low * low     ? TriangleTree::Range::below
                                         : squared < high * high ? TriangleTree::Range::between
                                                                 : TriangleTree::Range::beyond;
      uint32_t start = other;
      assert_true(tree.compare(p, low, high, start) == wanted);
      assert_true(start < row.triangles.size());
      assert_true(tree.compare(p, low, high, start) == wanted);
    }
}

void test_distances(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const TriangleTree tree(row.triangles, nullptr);
  const auto other_of = [&](Random& random) {
    return static_cast<uint32_t>(random.below(row.triangles.size()));
  };
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    Random random(7);
    for (size_t i = 0; i < 16 + test_count(800); ++i) {
      const Vec3 p = some_point(random, row, i);
      check_point(row, tree, p, other_of(random));
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

bool grazes(const Row& row, const Ray& ray) {
  for (const TreeTriangle& t : row.triangles) {
    const Vec3 normal = cross(t.u, t.v);
    if (std::abs(dot(normal, ray.direction)) < 1e-4 * length(normal)) return true;
  }
  return false;
}

/// Whether and where a ray crosses a triangle, or passes it at less than `margin`: the definition.
bool crosses(const TreeTriangle& t, const Ray& ray, double from, double to, double margin,
             double& at) {
  const Vec3 normal = cross(t.u, t.v), away = cross(ray.direction, t.v);
  const double across = dot(away, t.u);
  if (!(std::abs(across) > 0x1p-40 * length(normal))) return false;
  const double inverse = 1 / across;
  const Vec3 w = ray.origin - t.a, q = cross(w, t.u);
  const double of_u = dot(w, away) * inverse, of_v = dot(ray.direction, q) * inverse;
  const double room = margin * std::sqrt(t.longest_squared()) * std::abs(inverse);
  at = dot(t.v, q) * inverse;
  return of_u >= -room && of_v >= -room && of_u + of_v <= 1 + room && at >= from && at <= to;
}

/// Blocks of eight triangles say what the definition says of each, bit for bit.
void check_blocks(const Row& row, const Ray& ray, double from, double to, double margin) {
  for (size_t first = 0; first < row.triangles.size(); first += tree_width) {
    TriangleBlock block;
    const auto triangle = [&](uint32_t i) {
      return row.triangles[std::min(first + i, row.triangles.size() - 1)];
    };
    for (uint32_t i = 0; i < tree_width; ++i) block.set(i, triangle(i));
    alignas(64) double at[tree_width];
    const uint32_t bits = meet_triangles(block, ray, from, to, margin, at);
    for (uint32_t i = 0; i < tree_width; ++i) {
      double t = 0;
      const bool is_crossed = crosses(triangle(i), ray, from, to, margin, t);
      if (is_crossed != (bits >> i & 1) || (is_crossed && t != at[i]))
        fail_msg("triangle %zu: %d at %.17g, not %d at %.17g", first + i, bits >> i & 1, at[i],
                 is_crossed, t);
    }
  }
}

/// The numbers that the tree gives the triangles, by what is nearest to their middles.
std::vector<uint32_t> numbers_of(const Row& row, const TriangleTree& tree) {
  std::vector<uint32_t> numbers;
  for (const TreeTriangle& t : row.triangles)
    numbers.push_back(tree.nearest(t.a + (t.u + t.v) * (1.0 / 3), 0).triangle);
  return numbers;
}

/// A tree of a single triangle says whether and where a ray crosses that.
void test_crossings(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const TriangleTree tree(row.triangles, nullptr);
  const std::vector<uint32_t> numbers = numbers_of(row, tree);
  std::vector<TriangleTree> single;
  for (const TreeTriangle& t : row.triangles)
    single.emplace_back(std::vector<TreeTriangle>{t}, nullptr);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    Random random(8);
    for (size_t i = 0; i < 16 + test_count(300); ++i) {
      // Not about as far from triangles as the margin.
      constexpr size_t kinds[] = {0, 1, 2, 3, 6, 7};
      const Vec3 from = some_point(random, row, 8 * i + kinds[i % 6]);
      const Vec3 to = some_point(random, row, 8 * i + kinds[(i / 6 + i) % 6]);
      Vec3 way = to - from;
      if (i % 3 == 0) way = {0, 0, way.z};  // along the sides of boxes
      if (!(length(way) > 0)) continue;
      const Ray ray{from, way * (1 / length(way))};
      const double begin = i % 2 ? 0 : -length(way), end = length(way);
      const double margin = 1e-12 * row.size + 1e-14 * (max_magnitude(from) + end);
      check_blocks(row, ray, begin, end, margin);
      // What passes a needle at the margin may be outside of its own box.
      if (row.name == "degenerate") continue;
      TriangleTree::Crossing first{std::numeric_limits<double>::infinity(), {}}, one, got;
      bool wanted = false;
      uint32_t lowest = 0;  // of those at the first t
      for (size_t n = 0; n < single.size(); ++n)
        if (single[n].first_crossing(ray, begin, end, margin, one)) {
          if (!wanted || one.t < first.t || (one.t == first.t && numbers[n] < lowest)) {
            first = one;
            lowest = numbers[n];
          }
          wanted = true;
        }
      const bool is_found = tree.first_crossing(ray, begin, end, margin, got);
      if (wanted && !(is_found && got.t <= first.t))
        fail_msg("missed a crossing at %.17g", first.t);
      // What passes a triangle nearly along its plane may do so outside of its own box.
      if (grazes(row, ray)) continue;
      assert_int_equal(is_found, wanted);
      if (wanted && !(got.t == first.t)) fail_msg("%.17g, not %.17g", got.t, first.t);
      if (wanted && !(got.normal == first.normal)) fail_msg("another triangle at %.17g", got.t);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Points of a sliver are at no distance, and points beside it are as far as they were moved.
void distances_to_slivers_are_right(void**) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 along = random.direction(), across = unit_along(cross(along, random.direction()));
    const Vec3 above = cross(along, across), a = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    const double height = std::ldexp(1.0, -24 - i % 28), s = random.between(0.01, 0.99);
    const TreeTriangle sliver(a, a + along, a + along * s + across * height);
    const TriangleTree tree({sliver}, nullptr);
    const double u = random.unit(), v = random.unit() * (1 - u), away = random.below(2) ? 0 : 0.25;
    const double distance = tree.distance(sliver.a + sliver.u * u + sliver.v * v + above * away);
    if (!(std::abs(distance - away) <= 0x1p-22))
      fail_msg("height %g: %g, not %g", height, distance, away);
  }
}

/// From far away the margin vanishes in rounding: of a triangle along the sides of its box, both
/// are crossed at the same t up to that.
void boxes_without_depth_are_crossed_where_triangles_are(void**) {
  Random random(6);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    for (int i = 0; i < 1000; ++i) {
      const double x = random.between(-1, 1);
      const TreeTriangle flat({x, -1, -1}, {x, 1, -1}, {x, 0, 1});
      const TriangleTree tree({flat}, nullptr);
      const Vec3 on{x, random.between(-0.2, 0.2), random.between(-0.2, 0.2)};
      const Vec3 way = unit_along(Vec3{1, random.between(-0.2, 0.2), random.between(-0.2, 0.2)});
      const double away = random.between(1e6, 1e9);
      const Ray ray{on - way * away, way};
      TriangleTree::Crossing crossing, again;
      assert_true(tree.first_crossing(ray, 0, 2 * away, 1e-12, crossing));
      const double t = crossing.t;
      assert_true(tree.first_crossing(ray, t, 2 * away, 1e-12, again) && again.t == t);
      assert_true(tree.first_crossing(ray, t, t, 1e-12, again) && again.t == t);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Along its own line a needle seems to reach far beyond its ends: the margin over its height.
void needles_are_not_crossed_beyond_their_ends(void**) {
  const TreeTriangle needle({0, 0, 0}, {1, 0, 0}, {0.5, 0x1p-30, 0});
  const TriangleTree tree({needle}, nullptr);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    TriangleTree::Crossing crossing;
    assert_true(tree.first_crossing({{0.75, 0, -1}, {0, 0, 1}}, 0, 2, 0x1p-31, crossing));
    assert_true(crossing.t == 1);
    assert_false(tree.first_crossing({{1.25, 0, -1}, {0, 0, 1}}, 0, 2, 0x1p-31, crossing));
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(distances_to_slivers_are_right),
                              cmocka_unit_test(boxes_without_depth_are_crossed_where_triangles_are),
                              cmocka_unit_test(needles_are_not_crossed_beyond_their_ends)};
  std::vector<Row> all = rows();
  return cmocka_run_group_tests_name("triangle tree", tests, nullptr, nullptr) +
         run_for_each("distances", all, test_distances) +
         run_for_each("crossings", all, test_crossings);
}
