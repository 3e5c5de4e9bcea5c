// SPDX-License-Identifier: Apache-2.0
// The point nearest to planes: where a vertex of a cell lies.
// Source: Ju, Losasso, Schaefer and Warren, "Dual contouring of Hermite data", 2002: the minimum of
// the sum of squared distances, from the mean of the points where the planes do not determine it.
#pragma once

#include <cstddef>

#include "base/vec.h"

namespace msq {

/// Planes through points[i] with unit normals[i], 1 to 12 of them. Returns the point of a box,
/// which must hold the points, with the least sum of squared distances from the planes; the one
/// nearest to the mean of the points where they do not determine it. Where the planes meet outside
/// of the box, a point on the way there from the mean.
Vec3 nearest_to_planes(const Vec3* points, const Vec3* normals, size_t count, const Box3& box);

}  // namespace msq
