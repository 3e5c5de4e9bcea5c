// SPDX-License-Identifier: Apache-2.0
// A regular grid of sample points, and blocks of its rows as bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace msq {

/// Index of the first of `count` ascending samples origin + (first + i) * spacing that is >= value
/// (> value if `beyond`); count if there is none.
template <bool beyond = false>
uint64_t first_sample_from(double origin, double spacing, uint64_t first, uint64_t count,
                           double value) {
  const auto reached = [&](uint64_t i) {
    const double x = origin + static_cast<double>(first + i) * spacing;
    return beyond ? x > value : x >= value;
  };
  const double guess = std::ceil((value - origin) / spacing) - static_cast<double>(first);
  uint64_t i = guess <= 0                            ? 0
               : guess >= static_cast<double>(count) ? count
                                                     : static_cast<uint64_t>(guess);
  while (i > 0 && reached(i - 1)) --i;
  while (i < count && !reached(i)) ++i;
  return i;
}

/// Samples (i, j, k) at (x(i), y(j), z(k)). These three expressions are the sample positions, to
/// the last bit, on every path. Layers are evenly spaced or listed. The samples may be a window of
/// a larger grid: positions are those of the larger one.
struct SampleGrid {
  Vec3 origin;
  Vec3 spacing{1, 1, 1};
  uint64_t nx = 0, ny = 0, nz = 0;
  /// Ascending z of the layers of the whole grid, in place of origin.z + k * spacing.z.
  const double* heights = nullptr;
  std::array<uint64_t, 3> first{};  ///< sample (0, 0, 0) in the whole grid

  double x(uint64_t i) const { return origin.x + static_cast<double>(first[0] + i) * spacing.x; }
  double y(uint64_t j) const { return origin.y + static_cast<double>(first[1] + j) * spacing.y; }
  double z(uint64_t k) const {
    k += first[2];
    return heights ? heights[k] : origin.z + static_cast<double>(k) * spacing.z;
  }
  Vec3 at(uint64_t i, uint64_t j, uint64_t k) const { return {x(i), y(j), z(k)}; }

  /// Index of the first sample along an axis that is >= value (> value if `beyond`); the number of
  /// samples if there is none.
  template <bool beyond = false>
  uint64_t first_x_from(double value) const {
    return first_sample_from<beyond>(origin.x, spacing.x, first[0], nx, value);
  }
  template <bool beyond = false>
  uint64_t first_y_from(double value) const {
    return first_sample_from<beyond>(origin.y, spacing.y, first[1], ny, value);
  }
  template <bool beyond = false>
  uint64_t first_z_from(double value) const {
    if (!heights) return first_sample_from<beyond>(origin.z, spacing.z, first[2], nz, value);
    const double *const begin = heights + first[2], *const end = begin + nz;
    return static_cast<uint64_t>(
        (beyond ? std::upper_bound(begin, end, value) : std::lower_bound(begin, end, value)) -
        begin);
  }

  /// The largest number that positions are computed from.
  double magnitude() const {
    const auto last_of = [](uint64_t begin, uint64_t count) {
      return static_cast<double>(begin + count - (count > 0));
    };
    const Vec3 last{last_of(first[0], nx), last_of(first[1], ny), last_of(first[2], nz)};
    double largest = 0;
    for (int axis = 0; axis < (heights ? 2 : 3); ++axis)
      largest = std::max(largest, std::abs(origin[axis]) + last[axis] * spacing[axis]);
    if (heights && nz > 0) largest = std::max({largest, std::abs(z(0)), std::abs(z(nz - 1))});
    return largest;
  }
  /// Exceeds the difference of x(i) and x(j) + (i - j) * spacing.x, and likewise along y and z.
  /// Each of the two products and the two sums is rounded, by at most 2^-53 of magnitude().
  double rounding() const { return 0x1p-50 * magnitude(); }
};

/// A part of a grid, by the indices of its samples. All zeros: the whole.
struct SampleWindow {
  std::array<uint64_t, 3> first{}, count{};

  bool is_whole() const { return *this == SampleWindow{}; }
  friend bool operator==(const SampleWindow&, const SampleWindow&) = default;
};

/// Rows [begin, end) of a grid.
inline SampleGrid rows_of(const SampleGrid& grid, uint64_t begin, uint64_t end) {
  SampleGrid part = grid;
  part.first[1] += begin;
  part.ny = end - begin;
  return part;
}

/// A window of a whole grid; the grid itself if the window is all zeros. Throws Error(argument) if
/// the window is empty or reaches beyond the grid.
SampleGrid window_of(const SampleGrid& whole, const SampleWindow& window);

constexpr size_t bits_per_word = 64;
inline size_t words_for(uint64_t bits) {
  return (bits + bits_per_word - 1) / bits_per_word;
}

/// Rows j in [y0, y1) of layers k in [z0, z1) of a grid, all x, one bit per sample. Sample i is bit
/// i % 64 of word i / 64; bits past nx are 0. This is a view: it does not own the words.
struct RowBlock {
  const SampleGrid* grid = nullptr;
  uint64_t y0 = 0, y1 = 0, z0 = 0, z1 = 0;
  uint64_t* words = nullptr;
  size_t row_stride = 0, layer_stride = 0;  ///< in words

  uint64_t* row(uint64_t j, uint64_t k) const {
    return words + (k - z0) * layer_stride + (j - y0) * row_stride;
  }
  size_t row_words() const { return words_for(grid->nx); }
  uint64_t rows() const { return y1 - y0; }
  uint64_t layers() const { return z1 - z0; }
  Box3 box() const { return {grid->at(0, y0, z0), grid->at(grid->nx - 1, y1 - 1, z1 - 1)}; }
};

/// Sets bits first..last, inclusive, of a row.
inline void set_bits(uint64_t* row, uint64_t first, uint64_t last) {
  const uint64_t a = first / bits_per_word, b = last / bits_per_word;
  const uint64_t head = ~uint64_t{0} << (first % bits_per_word);
  const uint64_t tail = ~uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
  if (a == b) {
    row[a] |= head & tail;
    return;
  }
  row[a] |= head;
  for (uint64_t w = a + 1; w < b; ++w) row[w] = ~uint64_t{0};
  row[b] |= tail;
}

/// Sets the bits of all samples of a block, and no others.
inline void set_all_bits(const RowBlock& block) {
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      uint64_t* const row = block.row(j, k);
      row[block.row_words() - 1] = 0;
      set_bits(row, 0, block.grid->nx - 1);
    }
}

}  // namespace msq
