// SPDX-License-Identifier: Apache-2.0
// Colours as bytes of sRGB.
#include "ray/colour.h"

#include <cmath>

#include "msq_test.h"

using namespace msq;

namespace {

double byte_of(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

void rounds_to_the_nearest_byte(void**) {
  uint8_t last = 0;
  bool is_seen[256] = {};
  for (int i = 0; i <= 1 << 20; ++i) {
    const float linear = static_cast<float>(i) * 0x1p-20f;
    const uint8_t byte = srgb_byte(linear);
    // The standard's two pieces do not quite meet.
    if (!(std::abs(byte - byte_of(linear)) < 0.5 + 1e-4))
      fail_msg("%.9g becomes %d, not %.6f", static_cast<double>(linear), byte, byte_of(linear));
    assert_true(byte >= last);
    last = byte;
    is_seen[byte] = true;
  }
  for (const bool seen : is_seen) assert_true(seen);
}

void cuts_what_is_out_of_range(void**) {
  assert_int_equal(srgb_byte(-1), 0);
  assert_int_equal(srgb_byte(-0.0f), 0);
  assert_int_equal(srgb_byte(NAN), 0);
  assert_int_equal(srgb_byte(1.5f), 255);
  assert_int_equal(srgb_byte(INFINITY), 255);
}

void writes_straight_opacity(void**) {
  uint8_t rgba[4];
  write_rgba({0.25f, 0.125f, 0, 0.5f}, rgba);
  assert_int_equal(rgba[0], srgb_byte(0.5f));
  assert_int_equal(rgba[1], srgb_byte(0.25f));
  assert_int_equal(rgba[2], 0);
  assert_int_equal(rgba[3], 128);
  write_rgba({}, rgba);
  for (const uint8_t part : rgba) assert_int_equal(part, 0);
  write_rgba({1, 1, 1, 1.000001f}, rgba);
  assert_int_equal(rgba[3], 255);
}

void has_colours_of_its_own(void**) {
  assert_true(palette().size() == 8);
  for (const Vec3& colour : palette())
    assert_true(min_component(colour) >= 0 && max_component(colour) <= 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(rounds_to_the_nearest_byte),
      cmocka_unit_test(cuts_what_is_out_of_range),
      cmocka_unit_test(writes_straight_opacity),
      cmocka_unit_test(has_colours_of_its_own),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
