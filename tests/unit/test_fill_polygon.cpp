// SPDX-License-Identifier: Apache-2.0
// Paths cut by polygons in whole coordinates: against membership of dense points in the polygon,
// with corners on lines, lines on sides, and coordinates near the limit.
#include <algorithm>
#include <cmath>

#include "fill/polygon.h"
#include "fill/round_corners.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

using Rings = FillPolygon::Rings;

/// Crossing number in long double, for points away from the sides.
bool is_inside(const Rings& rings, long double x, long double y) {
  bool inside = false;
  for (const auto& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const IntPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      if ((static_cast<long double>(p.y) > y) == (static_cast<long double>(q.y) > y)) continue;
      const long double t =
          (y - static_cast<long double>(p.y)) / static_cast<long double>(q.y - p.y);
      inside ^= x < static_cast<long double>(p.x) + t * static_cast<long double>(q.x - p.x);
    }
  return inside;
}

double distance_to_sides(const Rings& rings, double x, double y) {
  double least = 1e300;
  for (const auto& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const IntPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      const double px = static_cast<double>(p.x), py = static_cast<double>(p.y);
      const double wx = static_cast<double>(q.x - p.x), wy = static_cast<double>(q.y - p.y);
      const double squared = wx * wx + wy * wy;
      const double t =
          squared > 0 ? std::clamp(((x - px) * wx + (y - py) * wy) / squared, 0.0, 1.0) : 0;
      least = std::min(least, std::hypot(x - px - t * wx, y - py - t * wy));
    }
  return least;
}

/// A star about the origin with a hole.
Rings star(Random& random, double size, size_t corners, IntPoint shift) {
  Rings rings(2);
  for (size_t ring = 0; ring < 2; ++ring)
    for (size_t i = 0; i < corners; ++i) {
      const double angle = 6.283185307 * static_cast<double>(i) / static_cast<double>(corners);
      const double r = size * (ring ? random.between(0.05, 0.3) : random.between(0.35, 1));
      rings[ring].push_back({shift.x + std::llround(r * std::cos(ring ? -angle : angle)),
                             shift.y + std::llround(r * std::sin(ring ? -angle : angle))});
    }
  return rings;
}

void test_parts_are_what_is_inside(void**) {
  Random random(1);
  for (size_t n = 0; n < test_count(300); ++n) {
    const IntPoint shift =
        n % 3 == 0 ? IntPoint{} : IntPoint{(int64_t{1} << 52) + 12345, -98765432101};
    const double size = n % 2 ? 1e6 : 300;
    const Rings rings = star(random, size, 3 + random.below(40), shift);
    const FillPolygon polygon(rings);
    IntPath path;
    path.is_closed = n % 2 == 0;
    for (size_t i = 0; i < 12; ++i)
      path.points.push_back({shift.x + std::llround(random.between(-1.2, 1.2) * size),
                             shift.y + std::llround(random.between(-1.2, 1.2) * size)});
    CountedVector<IntPath> parts;
    polygon.cut(path, parts);
    // Dense points along the path: those that are inside are as long as the parts.
    double inside = 0;
    const size_t steps = 4000;
    for (size_t i = 0; i < path.points.size() - !path.is_closed; ++i) {
      const IntPoint a = path.points[i], b = path.points[(i + 1) % path.points.size()];
      size_t hits = 0;
      for (size_t k = 0; k < steps; ++k) {
        const long double t = (static_cast<long double>(k) + 0.5L) / steps;
        const long double x =
            static_cast<long double>(a.x) + t * static_cast<long double>(b.x - a.x);
        const long double y =
            static_cast<long double>(a.y) + t * static_cast<long double>(b.y - a.y);
        hits += is_inside(rings, x, y);
      }
      inside += static_cast<double>(hits) / steps *
                std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y));
    }
    double total = 0;
    for (const IntPath& part : parts) {
      total += length_of(part);
      for (size_t i = 1; i < part.points.size(); ++i) {
        const IntPoint a = part.points[i - 1], b = part.points[i];
        const double x = 0.5 * static_cast<double>(a.x - 2 * shift.x + b.x),
                     y = 0.5 * static_cast<double>(a.y - 2 * shift.y + b.y);
        Rings local = rings;
        for (auto& ring : local)
          for (IntPoint& p : ring) p = {p.x - shift.x, p.y - shift.y};
        if (!is_inside(local, x, y) && distance_to_sides(local, x, y) > 1.5)
          fail_msg("a part leaves the polygon by %g", distance_to_sides(local, x, y));
      }
    }
    // Each end is rounded, and each change is within a step.
    const double room = 12 * 2.4 * size / steps * 6 + 4 * static_cast<double>(parts.size() + 1);
    if (std::abs(total - inside) > room)
      fail_msg("polygon %zu: parts of %g, inside %g, room %g", n, total, inside, room);
  }
}

/// Random lines and polygons with corners on a coarse grid, so that all ties occur: parts are those
/// of the path in the polygon shifted by a little. A crossing too many or too few would lose a part
/// of the grid's width.
void test_ties_are_consistent(void**) {
  Random random(2);
  constexpr int64_t wide = 10000;
  const auto corner = [&] {
    return IntPoint{wide * static_cast<int64_t>(random.below(5)),
                    wide * static_cast<int64_t>(random.below(5))};
  };
  size_t closed = 0, cut = 0;
  for (size_t n = 0; n < test_count(20000); ++n) {
    Rings rings(1 + random.below(2));
    for (auto& ring : rings)
      for (size_t i = 0, count = 3 + random.below(4); i < count; ++i) ring.push_back(corner());
    const FillPolygon polygon(rings);
    const auto shifted_has = [&](long double x, long double y) {
      return is_inside(rings, x - 1e-3L, y - 1e-7L);
    };
    for (int k = 0; k < 8; ++k) {
      const IntPoint p = corner();
      assert_int_equal(polygon.inside(p), shifted_has(p.x, p.y));
    }
    IntPath path;
    path.is_closed = random.below(2);
    for (size_t i = 0, count = 3 + random.below(3); i < count; ++i) {
      const IntPoint p = corner();
      if (path.points.empty() || !(path.points.back() == p)) path.points.push_back(p);
    }
    if (path.points.size() < 3 || path.points.front() == path.points.back()) continue;
    CountedVector<IntPath> parts;
    polygon.cut(path, parts);
    double inside = 0, total = 0;
    const size_t steps = 240;
    for (size_t i = 0; i < path.points.size() - !path.is_closed; ++i) {
      const IntPoint a = path.points[i], b = path.points[(i + 1) % path.points.size()];
      for (size_t s = 0; s < steps; ++s) {
        const long double t = (static_cast<long double>(s) + 0.5L) / steps;
        if (shifted_has(static_cast<long double>(a.x) + t * static_cast<long double>(b.x - a.x),
                        static_cast<long double>(a.y) + t * static_cast<long double>(b.y - a.y)))
          inside +=
              std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)) / steps;
      }
    }
    for (const IntPath& part : parts) {
      total += length_of(part);
      closed += part.is_closed;
    }
    cut += parts.size();
    if (std::abs(total - inside) > 0.2 * wide)
      fail_msg("path %zu: parts of %g, inside %g", n, total, inside);
  }
  assert_true(test_scale() < 1 || (closed > 0 && cut > 1000));
}

void test_sides_of_the_border(void**) {
  const FillPolygon square({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}});
  const auto parts_of = [&](IntPath path) {
    CountedVector<IntPath> parts;
    square.cut(path, parts);
    return parts;
  };
  // The polygon counts as shifted to the upper right: the sides at 10 are inside, those at 0 are
  // not.
  assert_int_equal(parts_of({{{2, 10}, {8, 10}}, false}).size(), 1);
  assert_int_equal(parts_of({{{2, 0}, {8, 0}}, false}).size(), 0);
  assert_int_equal(parts_of({{{10, 2}, {10, 8}}, false}).size(), 1);
  assert_int_equal(parts_of({{{0, 2}, {0, 8}}, false}).size(), 0);
  // Through two corners.
  auto parts = parts_of({{{-5, -5}, {15, 15}}, false});
  assert_int_equal(parts.size(), 1);
  assert_true((parts[0].points == CountedVector<IntPoint>{{0, 0}, {10, 10}}));
  // Touching a corner from outside leaves nothing.
  assert_int_equal(parts_of({{{-5, 5}, {5, -5}}, false}).size(), 0);
  // Closed lines: within, and over the border from a first point inside.
  parts = parts_of({{{2, 2}, {8, 2}, {5, 8}}, true});
  assert_int_equal(parts.size(), 1);
  assert_true(parts[0].is_closed);
  assert_int_equal(parts[0].points.size(), 3);
  parts = parts_of({{{5, 5}, {15, 5}, {15, 7}, {5, 7}}, true});
  assert_int_equal(parts.size(), 1);
  assert_false(parts[0].is_closed);
  assert_true((parts[0].points == CountedVector<IntPoint>{{10, 7}, {5, 7}, {5, 5}, {10, 5}}));
}

/// Corners are rounded where the curve is within the polygon.
void test_corners(void**) {
  // An L; its corner that points inwards is at (1000, 1000).
  const FillPolygon polygon(
      {{{0, 0}, {3000, 0}, {3000, 1000}, {1000, 1000}, {1000, 3000}, {0, 3000}}});
  IntPath path{{{2900, 990}, {990, 990}, {990, 2000}, {100, 2000}, {100, 100}, {2900, 100}}, false};
  const CountedVector<IntPoint> given = path.points;
  round_corners(path, 300, polygon);
  assert_true(path.points.front() == given.front() && path.points.back() == given.back());
  const auto has = [&](IntPoint p) {
    return std::find(path.points.begin(), path.points.end(), p) != path.points.end();
  };
  assert_true(has({990, 990}));  // its curve would leave the polygon
  assert_false(has({100, 100}));
  assert_true(has({100, 400}) && has({400, 100}) && has({175, 175}));
  IntPath same = path;  // a curve smaller than the unit of coordinates
  round_corners(same, 0.3, polygon);
  assert_int_equal(same.points.size(), path.points.size());

  IntPath closed{{{100, 100}, {900, 100}, {900, 900}, {100, 900}}, true};
  round_corners(closed, 1e9, polygon);
  assert_int_equal(closed.points.size(), 16);  // four curves, each ends where the next begins
  for (const IntPoint p : closed.points)
    assert_true(distance(p, {500, 500}) > 399 && distance(p, {500, 500}) < 430);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_parts_are_what_is_inside),
      cmocka_unit_test(test_ties_are_consistent),
      cmocka_unit_test(test_sides_of_the_border),
      cmocka_unit_test(test_corners),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
