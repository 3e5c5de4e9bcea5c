// SPDX-License-Identifier: Apache-2.0
// The frame of layers: rows of pixels lie along its first axis, rows follow each other along the
// second, and layers along the third.
#pragma once

#include <array>
#include <cmath>

#include "base/vec.h"

namespace msq {

struct LayerFrame {
  Vec3 origin;
  /// Orthonormal. Left-handed frames mirror.
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  /// Where a point (u, v, w) of the frame is in the model: the definition of samples, to the last
  /// bit.
  Vec3 to_model(Vec3 p) const { return origin + ((axes[0] * p.x + axes[1] * p.y) + axes[2] * p.z); }
  Vec3 from_model(Vec3 p) const {
    const Vec3 d = p - origin;
    return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)};
  }
  /// Exceeds the distance from to_model() of a point to where it would be without rounding: each
  /// component is a sum of three products and a number.
  double rounding(Vec3 p) const { return 0x1p-48 * (max_magnitude(p) + max_magnitude(origin)); }

  /// For each axis, the axis of the model that it is, if it is one and the origins are the same.
  /// Then coordinates are those of the model, to the last bit, in another order. Otherwise -1.
  std::array<int, 3> model_axes() const {
    std::array<int, 3> found{-1, -1, -1};
    if (origin.x != 0 || origin.y != 0 || origin.z != 0) return found;
    for (size_t i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        if (axes[i][axis] == 0) continue;
        if (axes[i][axis] != 1 || found[i] >= 0) return {-1, -1, -1};
        found[i] = axis;
      }
    return found;
  }
  bool is_that_of_model() const { return model_axes() == std::array<int, 3>{0, 1, 2}; }

  /// Enclose a box of the other side, with the rounding of to_model().
  Box3 to_model(const Box3& box) const;
  Box3 from_model(const Box3& box) const;
};

}  // namespace msq
