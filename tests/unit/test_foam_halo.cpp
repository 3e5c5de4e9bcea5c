// SPDX-License-Identifier: Apache-2.0
// The halo of a cell holds every seed that its bound calls for, and seeds_that_matter() leaves out
// none that is nearest to a point within the radius of the cell.
#include "structure/foam/paper/halo.h"

#include <algorithm>

#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

double box_distance(const Box3& box, Vec3 p) {
  return length(max(max(box.min - p, p - box.max), Vec3{}));
}

bool has(const std::vector<Vec3>& seeds, Vec3 seed) {
  return std::find(seeds.begin(), seeds.end(), seed) != seeds.end();
}

struct Case {
  Vec3 scale;
  double radius;
  size_t count;  // of the halo's seeds
};
const Case cases[] = {{{1, 1, 1}, 0.26, 125},       {{1, 1, 1}, 0.2679, 125},
                      {{1, 1, 1}, 0.268, 343},      {{1, 1, 1}, 0.3, 343},
                      {{1, 1, 1}, 0.5, 343},        {{1, 1, 1}, 0.9, 343},
                      {{1, 1, 0.5}, 0.26, 225},     {{1, 1, 0.5}, 0.49, 225},
                      {{1, 0.25, 0.25}, 0.25, 845}, {{0.5, 1, 0.75}, 0.1, 7 * 5 * 5}};

void test_halo(void**) {
  Random random(3);
  for (const Case& c : cases)
    for (size_t n = test_count(20); n > 0; --n) {
      const FoamSeeds seeds(random.bits(), 1, c.scale);
      const CellIndex cell{static_cast<int32_t>(random.below(2000)) - 1000, -7, 3};
      std::vector<Vec3> halo;
      halo_seeds(seeds, cell, c.radius, halo);
      assert_int_equal(halo.size(), c.count);
      const Box3 box{{0, 0, 0}, c.scale};
      size_t wanted = 0;
      for (int z = -14; z <= 14; ++z)
        for (int y = -14; y <= 14; ++y)
          for (int x = -14; x <= 14; ++x) {
            const Vec3 seed = seeds.at(cell, x, y, z);
            if (box_distance(box, seed) > seeds.empty_radius() + c.radius) continue;
            ++wanted;
            if (!has(halo, seed))
              fail_msg("r %g: no seed of cell %d, %d, %d in the halo", c.radius, x, y, z);
          }
      assert_true(wanted > 20);
    }
}

void test_seeds_that_matter(void**) {
  Random random(4);
  for (const Case& c : cases) {
    size_t kept = 0, all = 0;
    for (double jitter : {1.0, 0.5, 0.0})
      for (size_t n = test_count(10); n > 0; --n) {
        const FoamSeeds seeds(random.bits(), jitter, c.scale);
        std::vector<Vec3> halo;
        halo_seeds(seeds, {5, 6, 7}, c.radius, halo);
        const std::vector<Vec3> matter = seeds_that_matter(halo, c.scale, c.radius);
        kept += matter.size();
        all += halo.size();
        // In the halo's order.
        auto at = halo.begin();
        for (const Vec3& seed : matter) at = std::find(at, halo.end(), seed);
        assert_true(at != halo.end());
        const Box3 grown = Box3{{0, 0, 0}, c.scale}.grown(c.radius);
        for (int i = 0; i < 300; ++i) {
          Vec3 p = random.in_box(grown);
          if (i % 3 == 0)  // corners and faces of the box
            for (int axis = 0; axis < 3; ++axis)
              if (random.below(3)) p[axis] = random.below(2) ? grown.min[axis] : grown.max[axis];
          const Vec3 nearest = *std::min_element(halo.begin(), halo.end(), [&](Vec3 a, Vec3 b) {
            return dot(a - p, a - p) < dot(b - p, b - p);
          });
          assert_true(has(matter, nearest));
        }
      }
    print_message(
        "r %g, cells %g x %g x %g: %.1f of %.0f seeds matter\n", c.radius, c.scale.x, c.scale.y,
        c.scale.z,
        static_cast<double>(kept) / static_cast<double>(all) * static_cast<double>(c.count),
        static_cast<double>(c.count));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_halo),
                              cmocka_unit_test(test_seeds_that_matter)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
