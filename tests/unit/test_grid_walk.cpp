// SPDX-License-Identifier: Apache-2.0
// Walks of rays through grids: each part of a ray lies in its cell, the parts follow each other
// from end to end, and walks end, also where numbers are so large that cells are not told apart.
#include "base/grid_walk.h"

#include <limits>

#include "base/status.h"
#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Walk {
  size_t cells = 0;
  double end = -infinity;
};

/// Fails where a part does not begin where the last one ended, or its middle is not in its cell, by
/// more than rounding.
Walk walk(const Ray& ray, Vec3 size, double from, double to) {
  Walk walked;
  walk_grid(
      ray, ray.at(from), [&] { return ray.at(to); }, size, from, to, nullptr,
      [&](const int64_t(&index)[3], double begin, double end) {
        if (walked.cells > 0 && begin != walked.end) fail_msg("a gap at %.17g", begin);
        if (walked.cells == 0 && begin != from) fail_msg("it begins at %.17g", begin);
        const Vec3 middle = ray.at(0.5 * (begin + end));
        const double room = 0x1p-48 * (max_magnitude(ray.at(from)) + max_magnitude(ray.at(to)));
        for (int axis = 0; axis < 3; ++axis) {
          const double low = static_cast<double>(index[axis]) * size[axis];
          if (middle[axis] < low - room || middle[axis] > low + size[axis] + room)
            fail_msg("%.17g is not in cell %lld", middle[axis],
                     static_cast<long long>(index[axis]));
        }
        ++walked.cells;
        walked.end = end;
        return true;
      });
  return walked;
}

void follows_rays_from_end_to_end(void**) {
  Random random(3);
  for (size_t i = 0; i < test_count(20000); ++i) {
    const double far = i % 4 == 0 ? 1e6 : 20;
    Vec3 a = random.in_box({{-far, -far, -far}, {far, far, far}}), b = a;
    for (int axis = 0; axis < 3; ++axis)
      if (i % 3 == 0) a[axis] = std::round(a[axis]);  // along planes, through edges and corners
    if (i % 5 == 0)
      b[static_cast<int>(random.below(3))] += random.between(-30, 30);
    else
      b = a + random.in_box({{-20, -20, -20}, {20, 20, 20}});
    const double way = length(b - a);
    if (!(way > 0)) continue;
    const Vec3 size{1, i % 2 ? 1.0 : 0.7, i % 7 ? 1.0 : 3.1};
    const double from = i % 2 ? 0 : random.between(-5, 5);
    const Walk walked = walk({a, (b - a) * (1 / way)}, size, from, from + way);
    assert_true(walked.cells > 0 && walked.end == from + way);
  }
}

void ends_wherever_it_begins(void**) {
  const double numbers[] = {0,
                            1,
                            1e9,
                            1e15,
                            1e19,
                            1e30,
                            1e40,
                            1e100,
                            1e300,
                            infinity,
                            std::numeric_limits<double>::quiet_NaN()};
  Random random(5);
  size_t cells = 0;
  for (const double x : numbers)
    for (const double y : numbers)
      for (const int sign : {-1, 1}) {
        Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        if (sign > 0) d = {0, 0, 1};
        const Ray ray{{sign * x, y, 0.5}, d * (1 / length(d))};
        walk_grid(
            ray, ray.at(0), [&] { return ray.at(50); }, {1, 1, 1}, 0, 50, nullptr,
            [&](const int64_t(&)[3], double, double) {
              ++cells;
              return true;
            });
      }
  assert_true(cells > 0);
  // Cells no wider than the rounding of coordinates.
  for (const double size : {1e-20, 1e-3}) {
    const Ray ray{{1e13, 1e13, -1e13}, {1, 0, 0}};
    size_t count = 0;
    walk_grid(
        ray, ray.at(0), [&] { return ray.at(1); }, {size, size, size}, 0, 1, nullptr,
        [&](const int64_t(&)[3], double, double) { return ++count < 10000; });
    assert_true(count > 0);
  }
}

void stops_with_its_job(void**) {
  Job job;
  const Ray ray{{0.5, 0.5, 0.5}, {1, 0, 0}};
  size_t cells = 0;
  try {
    walk_grid(
        ray, ray.at(0), [&] { return ray.at(infinity); }, {1, 1, 1}, 0, infinity, &job,
        [&](const int64_t(&)[3], double, double) {
          if (++cells == 1000) job.cancel();
          return true;
        });
    fail_msg("it ended after %zu cells", cells);
  } catch (const Error& error) {
    assert_true(error.status == Status::cancelled);
    assert_true(cells < 1100);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(follows_rays_from_end_to_end),
                              cmocka_unit_test(ends_wherever_it_begins),
                              cmocka_unit_test(stops_with_its_job)};
  return cmocka_run_group_tests_name("grid_walk", tests, nullptr, nullptr);
}
