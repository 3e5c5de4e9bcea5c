// SPDX-License-Identifier: Apache-2.0
// Points of a plane, sorted by the squares that hold them.
#pragma once

#include <cstdint>

namespace msq {

/// A point, in the square that holds it.
struct PointInSquare {
  double column, row;
  uint32_t point;

  friend bool operator<(const PointInSquare& a, const PointInSquare& b) {
    if (a.column != b.column) return a.column < b.column;
    if (a.row != b.row) return a.row < b.row;
    return a.point < b.point;
  }
};

}  // namespace msq
