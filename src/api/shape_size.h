// SPDX-License-Identifier: Apache-2.0
// How large shapes may be.
#pragma once

#include "api/guard.h"

namespace msq::api {

inline void check_size(double radius, Vec3 centre) {
  constexpr double most = 1e75;  // fourth powers of lengths stay finite
  if (radius > most || max_magnitude(centre) > most)
    fail(Status::argument,
         "a shape of radius or size %g at (%g, %g, %g) is too large; the limit is %g for each",
         radius, centre.x, centre.y, centre.z, most);
}

/// Throws Error(argument) unless min < max in each axis.
inline Box3 read_box(const double* min, const double* max) {
  const Box3 box{require_vector(min, "min"), require_vector(max, "max")};
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.min[axis] < box.max[axis]))
      fail(Status::argument, "min[%d] is %g and max[%d] is %g; min must be less", axis,
           box.min[axis], axis, box.max[axis]);
  check_size(max_magnitude(box.extent()), box.min);
  return box;
}

}  // namespace msq::api
