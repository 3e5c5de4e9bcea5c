// SPDX-License-Identifier: Apache-2.0
#include "query/point_order.h"

#include <array>
#include <utility>

namespace msq {

namespace {

/// Bits of a coordinate, and of a key that one pass sorts by.
constexpr unsigned axis_bits = 7, pass_bits = 11, number_bits = 32;
constexpr uint64_t number_mask = (uint64_t{1} << number_bits) - 1;
static_assert(3 * axis_bits <= 2 * pass_bits);

/// Two empty bits between those of a number.
constexpr auto spread = [] {
  std::array<uint32_t, 1 << axis_bits> table{};
  for (uint32_t n = 0; n < table.size(); ++n)
    for (unsigned bit = 0; bit < axis_bits; ++bit) table[n] |= (n >> bit & 1) << (3 * bit);
  return table;
}();

}  // namespace

std::span<const uint64_t> PointOrder::sort(std::span<const Vec3> points) {
  keyed_.resize(points.size());
  sorted_.resize(points.size());
  if (points.empty()) return sorted_;
  Box3 box{points[0], points[0]};
  for (const Vec3 p : points) box = {min(box.min, p), max(box.max, p)};
  constexpr double top = (1 << axis_bits) - 1;
  const double scale = top / max_component(box.extent());  // 0 if too far, infinite for one point
  for (size_t i = 0; i < points.size(); ++i) {
    uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = (points[i][axis] - box.min[axis]) * scale;
      const bool is_step = step >= 0 && step <= top;  // false for NaN
      key |= uint64_t{spread[is_step ? static_cast<uint32_t>(step) : 0]} << axis;
    }
    keyed_[i] = key << number_bits | i;
  }
  for (const unsigned shift : {number_bits, number_bits + pass_bits}) {
    const auto digit = [&](uint64_t keyed) { return keyed >> shift & ((1 << pass_bits) - 1); };
    std::array<uint32_t, 1 << pass_bits> ends{};
    for (const uint64_t keyed : keyed_) ++ends[digit(keyed)];
    uint32_t sum = 0;
    for (uint32_t& end : ends) sum += std::exchange(end, sum);
    for (const uint64_t keyed : keyed_) sorted_[ends[digit(keyed)]++] = keyed;
    keyed_.swap(sorted_);
  }
  for (size_t i = 0; i < points.size(); ++i) sorted_[i] = keyed_[i] & number_mask;
  return sorted_;
}

}  // namespace msq
