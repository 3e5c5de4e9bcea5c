// SPDX-License-Identifier: Apache-2.0
// An affine map that places an instance of a file.
#pragma once

#include "base/vec.h"

namespace msq {

struct Transform {
  Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};  ///< images of the unit vectors
  Vec3 origin;                                             ///< image of the origin

  Vec3 turned(Vec3 v) const { return x_axis * v.x + y_axis * v.y + z_axis * v.z; }
  Vec3 apply(Vec3 p) const { return turned(p) + origin; }
  double determinant() const { return dot(x_axis, cross(y_axis, z_axis)); }

  /// First `inner`, then this.
  Transform after(const Transform& inner) const {
    return {turned(inner.x_axis), turned(inner.y_axis), turned(inner.z_axis), apply(inner.origin)};
  }
};

}  // namespace msq
