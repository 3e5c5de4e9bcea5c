// SPDX-License-Identifier: Apache-2.0
// The order of points: each number once, and neighbours close together.
#include "query/point_order.h"

#include <algorithm>

#include "random.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  std::vector<Vec3> points;
  double part;  ///< of the way in the given order, at most
};

std::vector<Row> rows() {
  Random random(1);
  const Box3 cube{{-1, -1, -1}, {1, 1, 1}};
  std::vector<Vec3> anywhere(20000), flat, line, far;
  for (Vec3& p : anywhere) p = random.in_box(cube);
  for (const Vec3 p : anywhere) {
    flat.push_back({5 + p.x, p.y, 3});
    line.push_back({0, 0, 1e-30 * p.z});
    far.push_back(p * 1e308);
  }
  return {{"none", {}, 1},
          {"one", {{1, 2, 3}}, 1},
          {"equal", std::vector<Vec3>(100, {1, 2, 3}), 1},
          {"anywhere", anywhere, 0.1},
          {"flat", flat, 0.05},
          {"on a line", line, 0.02},
          {"farther than numbers tell", far, 2}};
}

double way(Vec3 from, Vec3 to) {
  return std::hypot(std::hypot(to.x - from.x, to.y - from.y), to.z - from.z);
}

void test_order(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  PointOrder order;
  const std::span<const uint64_t> sorted = order.sort(row.points);
  std::vector<uint64_t> numbers(sorted.begin(), sorted.end());
  double before = 0, after = 0;
  for (size_t i = 1; i < numbers.size(); ++i) {
    before += way(row.points[i - 1], row.points[i]);
    after += way(row.points[numbers[i - 1]], row.points[numbers[i]]);
  }
  std::sort(numbers.begin(), numbers.end());
  assert_int_equal(numbers.size(), row.points.size());
  for (size_t i = 0; i < numbers.size(); ++i) assert_int_equal(numbers[i], i);
  if (!(after <= row.part * before)) fail_msg("a way of %g, not of %g", after, before);
}

}  // namespace

int main() {
  std::vector<Row> all = rows();
  return run_for_each("order", all, test_order);
}
