// SPDX-License-Identifier: Apache-2.0
// Sums of the solid angles of a few triangles, for many points at once.
#pragma once

#include <cstddef>

#include "base/vec.h"
#include "shape/half_angles.h"

namespace msq {

struct CapTriangle {
  Vec3 corners[3];
  double twice_area;

  CapTriangle(Vec3 a, Vec3 b, Vec3 c) : corners{a, b, c}, twice_area(length(cross(b - a, c - a))) {}
};

/// For points in three arrays, which are padded by a vector.
struct CapSums {
  const double *x, *y, *z;
  double *re, *im, *turns;  ///< the state of HalfAngles
  double* error;            ///< bound of the error of the sum over 4 pi; 1 or more: none is known

  HalfAngles sum(size_t point) const {
    return {re[point], im[point], static_cast<int64_t>(turns[point])};
  }
};

/// `tolerance`: of positions, in coordinates of about 1.
void sum_caps(const CapTriangle* triangles, size_t count, double tolerance, size_t points,
              const CapSums& sums);

}  // namespace msq
