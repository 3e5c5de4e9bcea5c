// SPDX-License-Identifier: Apache-2.0
// set_bits and first_sample_from, in all small cases, against loops; windows and their refusals.
#include <vector>

#include "base/sample_bounds.h"
#include "base/status.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_set_bits(void**) {
  constexpr uint64_t bits = 200;  // four words, the last one partly used
  for (uint64_t first = 0; first < bits; ++first)
    for (uint64_t last = first; last < bits; ++last)
      for (uint64_t background : {uint64_t{0}, uint64_t{0x8000000000000001}}) {
        uint64_t row[4] = {background, background, background, background};
        set_bits(row, first, last);
        for (uint64_t i = 0; i < 256; ++i) {
          const bool wanted = (i >= first && i <= last) || (background >> (i % 64) & 1);
          if ((row[i / 64] >> (i % 64) & 1) != wanted)
            fail_msg("bits %d to %d: bit %d is wrong", int(first), int(last), int(i));
        }
      }
}

uint64_t first_by_loop(double origin, double spacing, uint64_t first, uint64_t count, double value,
                       bool beyond) {
  for (uint64_t i = 0; i < count; ++i) {
    const double x = origin + static_cast<double>(first + i) * spacing;
    if (beyond ? x > value : x >= value) return i;
  }
  return count;
}

void check_first(double origin, double spacing, uint64_t count, double value) {
  for (uint64_t first : {uint64_t{0}, uint64_t{3}, uint64_t{1000000}, uint64_t{INT32_MAX} - 7}) {
    const double start = origin - static_cast<double>(first) * spacing;
    const uint64_t from = first_sample_from(start, spacing, first, count, value);
    const uint64_t beyond = first_sample_from<true>(start, spacing, first, count, value);
    if (from != first_by_loop(start, spacing, first, count, value, false) ||
        beyond != first_by_loop(start, spacing, first, count, value, true))
      fail_msg("origin %.17g, spacing %.17g, %d from %d on, value %.17g: %d and %d", start, spacing,
               int(count), int(first), value, int(from), int(beyond));
  }
}

void test_first_sample(void**) {
  for (double origin : {-1.0, -0.3, 0.0, 0.1, 1000.7, -1e6, 1e15})
    for (double spacing : {1.0, 0.1, 1.0 / 3, 0.125, 1e-3})
      for (uint64_t count : {1, 2, 7}) {
        for (int i = -3; i < static_cast<int>(count) + 3; ++i)
          for (double part : {0.0, 0.25, 0.5}) {
            const double at = origin + (i + part) * spacing;
            check_first(origin, spacing, count, at);
            check_first(origin, spacing, count, std::nextafter(at, -1e300));
            check_first(origin, spacing, count, std::nextafter(at, 1e300));
          }
        for (double value : {-1e300, 1e300}) check_first(origin, spacing, count, value);
      }
  Random random(1);
  for (size_t n = test_count(200000); n > 0; --n) {
    const double origin = random.between(-10, 10), spacing = random.between(1e-3, 2);
    const uint64_t count = 1 + random.below(30);
    const double at = origin + static_cast<double>(random.below(count + 2)) * spacing;
    check_first(origin, spacing, count, n % 2 ? at : random.between(-20, 70));
  }
}

void test_windows(void**) {
  const double heights[] = {1, 2.5, 2.75, 9};
  SampleGrid whole;
  whole.origin = {0.1, -7, 3};
  whole.spacing = {0.1, 0.3, 1.0 / 3};
  whole.nx = 1000;
  whole.ny = 70;
  whole.nz = 4;
  for (bool is_listed : {false, true}) {
    whole.heights = is_listed ? heights : nullptr;
    const SampleGrid part = window_of(whole, {{990, 1, 2}, {10, 69, 2}});
    assert_int_equal(part.nx, 10);
    assert_int_equal(part.ny, 69);
    assert_int_equal(part.nz, 2);
    for (uint64_t i = 0; i < 10; ++i) assert_true(part.x(i) == 0.1 + double(990 + i) * 0.1);
    for (uint64_t j = 0; j < 69; ++j) assert_true(part.y(j) == -7 + double(1 + j) * 0.3);
    for (uint64_t k = 0; k < 2; ++k)
      assert_true(part.z(k) == (is_listed ? heights[2 + k] : 3 + double(2 + k) * (1.0 / 3)));
    assert_int_equal(part.first_x_from(part.x(4)), 4);
    assert_int_equal(part.first_x_from<true>(part.x(4)), 5);
    assert_int_equal(part.first_y_from(part.y(68)), 68);
    assert_int_equal(part.first_y_from<true>(part.y(68)), 69);
  }
  assert_true(window_of(whole, {}).nx == whole.nx);
}

void test_windows_refused(void**) {
  SampleGrid whole;
  whole.nx = whole.ny = whole.nz = 10;
  const SampleWindow wrong[] = {
      {{0, 0, 0}, {10, 10, 11}}, {{0, 10, 0}, {1, 1, 1}},         {{1, 0, 0}, {10, 10, 10}},
      {{0, 0, 0}, {1, 0, 1}},    {{0, 0, UINT64_MAX}, {1, 1, 2}}, {{0, 5, 0}, {1, UINT64_MAX, 1}},
  };
  for (const SampleWindow& window : wrong) try {
      window_of(whole, window);
      fail_msg("accepted");
    } catch (const Error& error) {
      assert_true(error.status == Status::argument);
    }
}

/// Of no set bit, one and several, in blocks that are parts of larger ones.
void test_bounds(void**) {
  Random random(5);
  SampleGrid grid;
  grid.nx = 150;
  grid.ny = 9;
  grid.nz = 6;
  constexpr size_t stride = 5, rows = 7, layers = 4;  // more words than samples need
  for (int repeat = 0; repeat < 500; ++repeat) {
    std::vector<uint64_t> words(stride * rows * layers, 0);
    RowBlock block;
    block.grid = &grid;
    block.y0 = 2;
    block.y1 = 2 + rows - 1;
    block.z0 = 1;
    block.z1 = 1 + layers;
    block.words = words.data();
    block.row_stride = stride;
    block.layer_stride = stride * rows;
    SampleBounds wanted{grid.nx, 0, grid.ny, 0, grid.nz, 0};
    for (int bit = 0; bit < repeat % 4; ++bit) {
      const auto i = static_cast<uint64_t>(random.between(0, 149.9));
      const uint64_t j = block.y0 + static_cast<uint64_t>(random.between(0, 5.9));
      const uint64_t k = block.z0 + static_cast<uint64_t>(random.between(0, 3.9));
      set_bits(block.row(j, k), i, i);
      wanted = {std::min(wanted.i0, i),     std::max(wanted.i1, i + 1), std::min(wanted.j0, j),
                std::max(wanted.j1, j + 1), std::min(wanted.k0, k),     std::max(wanted.k1, k + 1)};
    }
    SampleBounds found;
    assert_int_equal(find_bounds(block, found), repeat % 4 > 0);
    if (repeat % 4 == 0) continue;
    assert_int_equal(found.i0, wanted.i0);
    assert_int_equal(found.i1, wanted.i1);
    assert_int_equal(found.j0, wanted.j0);
    assert_int_equal(found.j1, wanted.j1);
    assert_int_equal(found.k0, wanted.k0);
    assert_int_equal(found.k1, wanted.k1);
  }
}

void test_words(void**) {
  assert_int_equal(words_for(1), 1);
  assert_int_equal(words_for(64), 1);
  assert_int_equal(words_for(65), 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_set_bits), cmocka_unit_test(test_first_sample),
      cmocka_unit_test(test_windows),  cmocka_unit_test(test_windows_refused),
      cmocka_unit_test(test_bounds),   cmocka_unit_test(test_words)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
