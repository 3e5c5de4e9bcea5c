// SPDX-License-Identifier: Apache-2.0
// Struts as input of the raster: component by component, so that several are set up at once.
#pragma once

#include <cmath>
#include <cstddef>

#include "base/simd.h"
#include "base/vec.h"

namespace msq {

/// Struts in model units, each with the minimum and maximum radius, without margins, at points in
/// its reach. Kernels read and write whole vectors: up to `padding` entries past the count.
struct StrutBatch {
  static constexpr size_t capacity = 64, padding = max_simd_doubles;

  size_t count = 0;
  double a[3][capacity + padding], b[3][capacity + padding];
  double low[capacity + padding], high[capacity + padding];
  /// If `linear`: at points p in a strut's reach, the radius differs from
  /// at_a + dot(gradient, p - a) by at most departure + dot(spread, |p - m|), where m is the middle
  /// of the strut and |.| takes the magnitude of each component.
  static constexpr double max_slope = 0.5;  // of each component of `gradient` and `spread`
  bool linear = false;
  double gradient[3][capacity + padding], at_a[capacity + padding];
  double departure[capacity + padding], spread[3][capacity + padding];

  bool full() const { return count == capacity; }
  Vec3 from(size_t i) const { return {a[0][i], a[1][i], a[2][i]}; }
  Vec3 to(size_t i) const { return {b[0][i], b[1][i], b[2][i]}; }
  Vec3 slope(size_t i) const { return {gradient[0][i], gradient[1][i], gradient[2][i]}; }
  double departure_at(size_t i, Vec3 from_middle) const {
    return departure[i] + spread[0][i] * std::abs(from_middle.x) +
           spread[1][i] * std::abs(from_middle.y) + spread[2][i] * std::abs(from_middle.z);
  }
  void push(Vec3 from, Vec3 to) {
    for (int axis = 0; axis < 3; ++axis) {
      a[axis][count] = from[axis];
      b[axis][count] = to[axis];
    }
    ++count;
  }
};

}  // namespace msq
