// SPDX-License-Identifier: Apache-2.0
// The linear field: its values, and that range() of a box encloses every value in it.
#include "field/gradient.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_values(void**) {
  const GradientField field({1, 2, 3}, 5, {1, 2, 7}, -3);
  assert_true(field.at({1, 2, 3}) == 5);
  assert_true(field.at({100, -7, 5}) == 1);
  assert_true(field.at({0, 0, 7}) == -3);
  assert_true(field.at({0, 0, 70}) == -3);
  assert_true(field.at({0, 0, -70}) == 5);
  assert_true(field.range().low == -3 && field.range().high == 5);
}

void test_range(void**) {
  Random random(6);
  size_t outside = 0, loose = 0, linear = 0, bent = 0, boxes = test_count(40000);
  for (size_t n = 0; n < boxes; ++n) {
    const double far = n % 3 ? 1 : 1e6, size = std::pow(10, random.between(-6, 2));
    const Vec3 from = random.in_box(Box3{}.grown(far));
    Vec3 to = from + random.in_box(Box3{}.grown(std::pow(10, random.between(-4, 2))));
    const double a = random.between(-1, 1), b = n % 5 ? random.between(-1, 1) : a;
    const GradientField field(from, a, to, b);
    const Vec3 corner = from + random.in_box(Box3{}.grown(2));
    const Box3 box{corner, corner + random.in_box({{0, 0, 0}, {size, size, size}})};
    const Interval range = field.range(box), all = field.range();
    if (range.low < all.low || range.high > all.high) ++outside;
    Vec3 gradient;
    const bool is_linear = field.is_linear(box, gradient);
    linear += is_linear;
    double least = 1e300, most = -1e300;
    for (int i = 0; i < 20; ++i) {
      Vec3 p = random.in_box(box);
      if (i < 8)
        p = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
             i & 4 ? box.max.z : box.min.z};
      const double v = field.at(p);
      outside += !(v >= range.low && v <= range.high);
      const double along = field.at(box.min) + dot(gradient, p - box.min);
      bent += is_linear && std::abs(v - along) > 0x1p-40 * std::abs(b - a);
      least = std::min(least, v);
      most = std::max(most, v);
    }
    // The corners hold the extremes: the range is not much wider than they are.
    const double slope = std::abs(b - a) / length(to - from);
    loose += (least - range.low) + (range.high - most) > 1e-9 * (1 + far * slope + size * slope);
  }
  assert_int_equal(outside, 0);
  assert_int_equal(loose, 0);
  assert_true(linear > boxes / 20);
  assert_int_equal(bent, 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_range)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
