// SPDX-License-Identifier: Apache-2.0
// What the spans of the void of a cell (void_spans.h) are computed in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simd.h"
#include "structure/foam/walls/void_spans.h"

namespace msq {

/// Planes on one side of spans, solved for x: x <= base - y_slope y - z_slope z on the right, >= on
/// the left.
struct SidePlanes {
  std::vector<float> base, y_slope, z_slope, shift;  // the last for the margin
  std::vector<float> inner;                          // the base, moved into the void by the shift
  size_t count = 0;
  float most = 0;  // of the sizes of shifts

  void clear(size_t room) {
    count = 0;
    most = 0;
    if (base.size() >= room) return;
    for (std::vector<float>* v : {&base, &y_slope, &z_slope, &shift, &inner}) v->resize(room);
  }
};

/// The work for one cell.
struct VoidWork {
  /// Rows that are looked at together.
  static constexpr size_t rows = 1024;
  static constexpr size_t padding = 2 * max_simd_doubles;

  SidePlanes right, left;
  std::vector<VoidPlane> along;  // those along x, that no x changes
  // Bounds of y where rows meet the void: y <= base - slope z, and >= (rows_met-inl.h).
  std::vector<float> up_base, up_slope, down_base, down_slope;
  size_t ups = 0, downs = 0;
  // For each layer: the first row that may meet the void, and how many.
  std::vector<int32_t> first, count;
  // The rows at hand, layer after layer: without gaps, so that vectors of them are full.
  alignas(64) float y[rows + padding] = {}, z[rows + padding] = {};
  alignas(64) float low[rows + padding] = {}, high[rows + padding] = {};
  uint64_t* row[rows + padding] = {};

  size_t bytes() const {
    return sizeof *this + 10 * right.base.capacity() * sizeof(float) +
           4 * up_base.capacity() * sizeof(float) + 2 * first.capacity() * sizeof(int32_t);
  }
};

}  // namespace msq
