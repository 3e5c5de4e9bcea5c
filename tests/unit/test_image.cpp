// SPDX-License-Identifier: Apache-2.0
// Images: their trilinear function, its bounds, and the field that is one.
#include <numeric>

#include "field/grid.h"
#include "field_checks.h"
#include "images.h"

using namespace msq;
using namespace msq::test;

namespace {

/// From the eight weights, in another order than the image joins them.
template <class T>
double trilinear(const std::vector<T>& values, ImageSize size, Vec3 u) {
  const uint64_t n[3] = {size.x, size.y, size.z};
  uint64_t cell[3];
  double f[3], sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] = std::clamp(u[axis], 0.0, static_cast<double>(n[axis] - 1));
    cell[axis] = static_cast<uint64_t>(u[axis]);
    f[axis] = u[axis] - static_cast<double>(cell[axis]);
  }
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    uint64_t at[3];
    for (int axis = 0; axis < 3; ++axis) {
      const bool next = corner >> axis & 1;
      weight *= next ? f[axis] : 1 - f[axis];
      at[axis] = std::min(cell[axis] + next, n[axis] - 1);
    }
    sum += weight * static_cast<double>(values[(at[2] * n[1] + at[1]) * n[0] + at[0]]);
  }
  return sum;
}

template <class T>
void check_type(double low, double high) {
  Random random(11);
  const ImageSize sizes[] = {{7, 5, 6}, {1, 9, 4}, {13, 1, 1}, {1, 1, 1}, {2, 2, 2}, {70, 6, 9}};
  for (const ImageSize size : sizes) {
    std::vector<T> values(size.x * size.y * size.z);
    for (T& v : values) v = static_cast<T>(random.between(low, high));
    // A part that is constant.
    if (size.x == 70)
      for (size_t i = 0; i < values.size(); ++i)
        if (i % 70 >= 25) values[i] = static_cast<T>(high);
    for (bool is_turned : {false, true}) {
      ImageFrame frame{{1.25, -3, 0.5}, {0.5, 0.25, 2}, {}};
      if (is_turned) frame.rotation = skew_rotation();
      const GridField field(make_image(values, size, frame));
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      assert_true(field.range().low == static_cast<double>(*least));
      assert_true(field.range().high == static_cast<double>(*most));
      const Vec3 extent{double(size.x), double(size.y), double(size.z)};
      const Box3 around{Vec3{-2, -2, -2}, extent + Vec3{1, 1, 1}};
      for (size_t n = 0; n < test_count(2000); ++n) {
        Vec3 u = random.in_box(around);
        if (n % 4 == 0) u = {std::round(u.x), u.y, std::round(u.z)};
        const Vec3 p = frame.rotation.apply(u * frame.spacing) + frame.origin;
        const double wanted = trilinear(values, size, u);
        if (!(std::abs(field.at(p) - wanted) <= 1e-12 * (high - low)))
          fail_msg("%.17g, not %.17g", field.at(p), wanted);
      }
      const Vec3 reach = around.extent() * frame.spacing;
      const Box3 space = Box3{frame.origin, frame.origin}.grown(max_component(reach));
      const FieldOutcome outcome = check_field(field, space, 1e-6, 40, test_count(3000), random);
      assert_true(outcome.linear > 0 || values.size() > 1);
      if (size.x == 70) assert_true(outcome.linear > outcome.boxes / 20);
    }
  }
}

/// The spread of parts of arrays against their samples one by one. Nothing past the array is read.
template <class T>
void check_spread(double low, double high, Random& random) {
  for (size_t n = 0; n < test_count(300); ++n) {
    uint64_t size[3], begin[3], count[3];
    for (int axis = 0; axis < 3; ++axis) {
      const uint64_t most = n % 10 == 0 && axis == 0 ? 600 : 12;
      size[axis] = 1 + random.below(most);
      begin[axis] = random.below(size[axis]);
      count[axis] = 1 + random.below(size[axis] - begin[axis]);
    }
    std::vector<T> values(size[0] * size[1] * size[2]);
    for (T& v : values) v = static_cast<T>(random.between(low, high));
    const uint64_t step[3] = {1, size[0], size[0] * size[1]};
    const T* const first = &values[begin[0] + begin[1] * step[1] + begin[2] * step[2]];
    ImageSpread wanted{{double(*first), double(*first)}, {}};
    for (int axis = 0; axis < 3; ++axis)
      if (count[axis] > 1) {
        wanted.slopes.min[axis] = std::numeric_limits<double>::infinity();
        wanted.slopes.max[axis] = -std::numeric_limits<double>::infinity();
      }
    for (uint64_t k = 0; k < count[2]; ++k)
      for (uint64_t j = 0; j < count[1]; ++j)
        for (uint64_t i = 0; i < count[0]; ++i) {
          const T* const at = first + i + j * step[1] + k * step[2];
          wanted.range.low = std::min(wanted.range.low, double(*at));
          wanted.range.high = std::max(wanted.range.high, double(*at));
          const uint64_t place[3] = {i, j, k};
          for (int axis = 0; axis < 3; ++axis) {
            if (place[axis] == 0) continue;
            const double d = double(*at) - double(*(at - step[axis]));
            wanted.slopes.min[axis] = std::min(wanted.slopes.min[axis], d);
            wanted.slopes.max[axis] = std::max(wanted.slopes.max[axis], d);
          }
        }
    const ImageSpread got = spread_of(first, count, step[1], step[2]);
    assert_true(got.range.low == wanted.range.low && got.range.high == wanted.range.high);
    for (int axis = 0; axis < 3; ++axis) {
      assert_true(got.slopes.min[axis] == wanted.slopes.min[axis]);
      assert_true(got.slopes.max[axis] == wanted.slopes.max[axis]);
    }
  }
}

void test_spread(void**) {
  Random random(12);
  check_spread<uint8_t>(0, 256, random);
  check_spread<int16_t>(-32768, 32768, random);
  check_spread<uint16_t>(0, 65536, random);
  check_spread<float>(-1, 1, random);
  check_spread<double>(-1e100, 1e100, random);
}

void test_uint8(void**) {
  check_type<uint8_t>(0, 256);
}
void test_int16(void**) {
  check_type<int16_t>(-2000, 3000);
}
void test_uint16(void**) {
  check_type<uint16_t>(0, 65536);
}
void test_float32(void**) {
  check_type<float>(-1, 1);
}
void test_float64(void**) {
  check_type<double>(100, 101);
}

/// Values are met exactly at the samples' places of a frame without rounding.
void test_samples_are_met(void**) {
  const ImageSize size{6, 5, 4};
  std::vector<uint16_t> values(120);
  std::iota(values.begin(), values.end(), uint16_t{400});
  const Image image = make_image(values, size, {{-1, 2, 8}, {0.5, 0.25, 4}, {}});
  for (uint64_t i = 0; i < 120; ++i) {
    const Vec3 at{double(i % 6), double(i / 6 % 5), double(i / 30)};
    assert_true(image.at(Vec3{-1, 2, 8} + at * Vec3{0.5, 0.25, 4}) == double(values[i]));
  }
}

/// Within a cell or two, and far from the rest of the image, ranges are those of the function.
void test_ranges_are_tight(void**) {
  const ImageSize size{40, 40, 40};
  const auto values = sampled<float>(size, [](Vec3 u) { return u.x + 2 * u.y - u.z; });
  const Image image = make_image(values, size, {});
  Random random(8);
  for (size_t n = 0; n < test_count(2000); ++n) {
    const Vec3 low = random.in_box({{0, 0, 0}, {38, 38, 38}});
    const Box3 box{low, low + random.in_box({{0, 0, 0}, {1, 1, 1}})};
    const Interval range = image.range(box);
    const double least = box.min.x + 2 * box.min.y - box.max.z,
                 most = box.max.x + 2 * box.max.y - box.min.z;
    assert_true(range.low <= least && range.low > least - 1e-5);
    assert_true(range.high >= most && range.high < most + 1e-5);
  }
  // Larger ones, as the pyramid's: not much more than twice as wide.
  for (size_t n = 0; n < test_count(2000); ++n) {
    const Vec3 low = random.in_box({{0, 0, 0}, {15, 15, 15}});
    const double side = random.between(5, 24);
    const Interval range = image.range(Box3{low, low + Vec3{side, side, side}});
    assert_true(range.high - range.low <= 4 * (2 * side + 8));
  }
}

void test_strides(void**) {
  // 3 x 2 x 2 values with gaps between rows and layers.
  std::vector<unsigned char> bytes(100, 255);
  for (int i = 0; i < 12; ++i) bytes[size_t(i % 3 + 5 * (i / 3 % 2) + 40 * (i / 6))] = uint8_t(i);
  const Image image(Image::Source{bytes.data(), Image::Type::uint8, {3, 2, 2}, 5, 40}, {},
                    std::make_shared<MemoryBudget>(uint64_t{0}));
  for (int i = 0; i < 12; ++i)
    assert_true(image.at({double(i % 3), double(i / 3 % 2), double(i / 6)}) == i);
  assert_true(image.range().high == 11);
}

void test_memory_is_accounted(void**) {
  const auto budget = std::make_shared<MemoryBudget>(uint64_t{20000});
  const std::vector<uint8_t> values(16 * 16 * 16);
  const Image::Source source{values.data(), Image::Type::uint8, {16, 16, 16}, 16, 256};
  {
    const Image image(source, {}, budget);
    assert_true(budget->held() == 4096 + ImageBounds::bytes_for({16, 16, 16}));
    assert_true(image.bounds().bytes() <= ImageBounds::bytes_for({16, 16, 16}));
    assert_true(budget->held() < 4096 * 5 / 4);
  }
  assert_true(budget->held() == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_spread),          cmocka_unit_test(test_uint8),
      cmocka_unit_test(test_int16),           cmocka_unit_test(test_uint16),
      cmocka_unit_test(test_float32),         cmocka_unit_test(test_float64),
      cmocka_unit_test(test_samples_are_met), cmocka_unit_test(test_ranges_are_tight),
      cmocka_unit_test(test_strides),         cmocka_unit_test(test_memory_is_accounted)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
