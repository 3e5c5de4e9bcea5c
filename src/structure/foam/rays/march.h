// SPDX-License-Identifier: Apache-2.0
// The surface of a foam near single points of rays.
#pragma once

#include "base/ray.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// The outward normal where a ray enters the foam at t; 0 if there is none that faces the ray.
Vec3 strut_normal(const FoamData& foam, const Ray& ray, double t);

/// A length along a ray from p, which is outside, within which the ray does not come within `room`
/// of a strut. It is at most a fraction of a cell, and ends before the strut by the tolerance. For
/// foams of one density.
double way_to_strut(const FoamData& foam, Vec3 p, Vec3 direction, double room);

/// Replaces an entry found within the tolerance by the exact entry into its strut. Returns whether
/// the bits are certainly those that walk_cells() finds.
bool sharpen_entry(const FoamData& foam, RaySearch& search);

}  // namespace msq
