// SPDX-License-Identifier: Apache-2.0
// The seeds of a brick whose edges are wanted.
#pragma once

namespace msq {

/// Cells from the brick's first one: [low, high) along each axis, at least one.
struct Owners {
  int low[3], high[3];

  static constexpr Owners all(int side) { return {{0, 0, 0}, {side, side, side}}; }
  bool hold(const Owners& others) const {
    for (int axis = 0; axis < 3; ++axis)
      if (others.low[axis] < low[axis] || others.high[axis] > high[axis]) return false;
    return true;
  }
};

}  // namespace msq
