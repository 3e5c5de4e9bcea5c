// SPDX-License-Identifier: Apache-2.0
// The surface of a foam about single points of rays.
#pragma once

#include "base/ray.h"
#include "structure/foam/foam.h"

namespace msq {

/// The outward normal where a ray enters the foam at t; 0 if there is none that faces the ray.
Vec3 strut_normal(const Foam& foam, const Ray& ray, double t);

/// Up to where a ray that is inside at `from` stays in a strut that holds it, as far as that is
/// seen from there, at most `to`; `from` if none is found. For foams of one radius.
double strut_exit(const Foam& foam, const Ray& ray, double from, double to);

/// How far a ray of some direction certainly goes on from p, which is outside, before it enters a
/// strut: up to a fraction of a cell, and short of the strut by the tolerance. For foams of one
/// density.
double way_to_strut(const Foam& foam, Vec3 p, Vec3 direction);

/// Makes of an entry that was found within the tolerance what the entry into its strut is exactly:
/// the bits that enter_by_cells() finds.
void sharpen_entry(const Foam& foam, RaySearch& search);

}  // namespace msq
