// SPDX-License-Identifier: Apache-2.0
// Distance from a point to the boundary of a beam.
#pragma once

#include "structure/beams/beam.h"

namespace msq {

/// From a point outside to the beam: exact except for rounding, which is subtracted; 0 inside.
double distance_to_beam(const Beam& beam, Vec3 p);

/// From a point inside the beam to its boundary: a lower bound, with rounding subtracted. It is the
/// maximum of two distances: to the boundary of the beam with half balls in place of whole ones,
/// and to that of a whole ball. It is exact for flat ends and half balls, and for equal radii.
double depth_in_beam(const Beam& beam, Vec3 p);

}  // namespace msq
