// SPDX-License-Identifier: Apache-2.0
// Cells of meshes that are decided: all points of segments in them, against the definition.
#include "shape/decided_cells.h"

#include <algorithm>
#include <cmath>

#include "msq_test.h"
#include "random.h"
#include "shape/mesh.h"

using namespace msq;
using namespace msq::test;

namespace {

std::shared_ptr<MemoryBudget> budget_of(uint64_t limit) {
  return std::make_shared<MemoryBudget>(limit);
}

/// Adds a bumpy ball of 2 * rings * rings triangles, or one turned inside out.
void add_ball(TriangleSoup& soup, Random& random, Vec3 center, double radius, uint32_t rings,
              bool is_hollow) {
  const auto first = static_cast<uint32_t>(soup.vertices.size());
  const double bumps = random.between(0, 0.4);
  const Vec3 turn{random.between(0, 6), random.between(0, 6), random.between(0.05, 1)};
  for (uint32_t i = 0; i <= rings; ++i)
    for (uint32_t j = 0; j < rings; ++j) {
      const double u = 3.14159265358979 * i / rings, v = 2 * 3.14159265358979 * j / rings;
      const double r =
          radius * (1 + bumps * std::sin(3 * u + turn.x) * std::sin(u) * std::cos(4 * v + turn.y));
      const bool is_pole = i == 0 || i == rings;
      const double s = is_pole ? 0 : std::sin(u);
      soup.vertices.push_back(center + Vec3{r * s * std::cos(v), r * s * std::sin(v) * turn.z,
                                            (is_pole ? radius : r) * std::cos(u)});
    }
  const auto at = [&](uint32_t i, uint32_t j) { return first + i * rings + j % rings; };
  for (uint32_t i = 0; i < rings; ++i)
    for (uint32_t j = 0; j < rings; ++j) {
      Triangle a{at(i, j), at(i + 1, j), at(i + 1, j + 1)};
      Triangle b{at(i, j), at(i + 1, j + 1), at(i, j + 1)};
      if (is_hollow) {
        std::swap(a[1], a[2]);
        std::swap(b[1], b[2]);
      }
      soup.triangles.push_back(a);
      soup.triangles.push_back(b);
    }
}

void test_segments(void**) {
  Random random(1);
  const size_t count = std::max<size_t>(test_count(60), 8);
  size_t decided = 0;
  for (size_t n = 0; n < count; ++n) {
    TriangleSoup soup;
    const double scale = std::pow(10, random.between(-3, 3));
    const double far = n % 4 == 0 ? 1000 : 1;
    const Vec3 place{far * scale * random.unit(), scale * random.unit(), scale * random.unit()};
    // A cavity with a ball in it; a ball that overlaps; needles where there are few rings.
    const uint32_t rings = 3 + static_cast<uint32_t>(random.below(30));
    add_ball(soup, random, place, scale, rings, false);
    add_ball(soup, random, place, 0.5 * scale, 3 + static_cast<uint32_t>(random.below(20)), true);
    add_ball(soup, random, place + Vec3{1.5 * scale, 0, 0}, 0.6 * scale,
             3 + static_cast<uint32_t>(random.below(20)), false);
    const Mesh mesh(soup, static_cast<WindingRule>(n % 3), budget_of(0));
    if (!mesh.facts().closed) continue;
    const Box3 box = mesh.bounds();
    const DecidedCells cells(
        soup, box, [&](Vec3 p) { return mesh.inside(p); }, budget_of(0), nullptr);
    for (int at = 0; at < 3000; ++at) {
      const auto any = [&] {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = random.between(box.min[axis], box.max[axis]);
        return p;
      };
      const Vec3 a = any();
      const double size = scale * std::pow(10, random.between(-4, 0.3));
      Vec3 b = a + Vec3{random.between(-size, size), random.between(-size, size),
                        random.between(-size, size)};
      b = max(box.min, min(box.max, b));
      // A ray's origin may be far behind.
      const double behind = at % 3 == 0 ? random.between(0, 50) : 0;
      const Ray ray{a - (b - a) * behind, b - a};
      if (!cells.is_on_one_side(ray, behind, behind + 1)) continue;
      ++decided;
      const DecidedCells::Side side = cells.side(ray.at(behind));
      assert_true(side != DecidedCells::Side::unknown);
      for (int i = 0; i <= 24; ++i) {
        const Vec3 p = ray.at(behind + i / 24.0);
        if (mesh.inside(p) != (side == DecidedCells::Side::inside))
          fail_msg("mesh %zu: %g %g %g is decided wrongly", n, p.x, p.y, p.z);
      }
    }
    // A ray says what bisection of the definition says.
    for (int at = 0; at < 100; ++at) {
      Ray ray;
      for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = random.between(box.min[axis], box.max[axis]);
        ray.direction[axis] = random.between(-1, 1);
      }
      ray.direction = ray.direction * (1 / length(ray.direction));
      const double to = 0.05 * scale;
      double t = -1;
      const bool enters = mesh.enter(ray, 0, to, t, nullptr);
      if (mesh.inside(ray.origin)) {
        assert_true(enters && t == 0);
      } else if (!enters) {
        for (int i = 0; i < 8; ++i) assert_false(mesh.inside(ray.at(to * i / 8)));
      }
    }
  }
  // Most of space is decided.
  if (decided < count * 500) fail_msg("%zu segments of %zu are decided", decided, count * 3000);
}

/// Without room in the budget, and from one side to the other.
void test_unknown(void**) {
  Random random(2);
  TriangleSoup soup;
  add_ball(soup, random, {0, 0, 0}, 1, 12, false);
  const Mesh mesh(soup, WindingRule::nonzero, budget_of(0));
  const auto inside = [&](Vec3 p) { return mesh.inside(p); };
  const Vec3 middle{0.01, 0.02, 0.03};
  const DecidedCells cells(soup, mesh.bounds(), inside, budget_of(0), nullptr);
  const Vec3 corner = mesh.bounds().min;
  const Ray diagonal{corner, mesh.bounds().extent()};
  assert_true(cells.side(middle) == DecidedCells::Side::inside);
  assert_true(cells.side(corner) == DecidedCells::Side::outside);
  // The ball begins at 0.5 (1 - 1 / sqrt(3)) = 0.21, its middle ends after 0.79.
  assert_true(cells.is_on_one_side(diagonal, 0, 0.15));
  assert_true(cells.is_on_one_side(diagonal, 0.3, 0.7));
  assert_false(cells.is_on_one_side(diagonal, 0, 0.5));
  assert_false(cells.is_on_one_side(diagonal, 0, 1));
  const Ray far{diagonal.origin - diagonal.direction * 0x1p14, diagonal.direction};
  assert_false(cells.is_on_one_side(far, 0x1p14, 0x1p14 + 0.15));
  const std::shared_ptr<MemoryBudget> none = budget_of(100);
  const DecidedCells without(soup, mesh.bounds(), inside, none, nullptr);
  assert_true(without.side(middle) == DecidedCells::Side::unknown);
  assert_false(without.is_on_one_side(diagonal, 0, 0.1));
  assert_int_equal(none->held(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_segments),
      cmocka_unit_test(test_unknown),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
