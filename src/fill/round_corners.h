// SPDX-License-Identifier: Apache-2.0
// Rounded corners of paths: a printer need not slow down as much for them.
#pragma once

#include "fill/polygon.h"

namespace msq {

/// Replaces each corner of a path by a parabola of four lines that begins and ends at most
/// `distance` from the corner, and at most half way to the next point. So no point of the path
/// moves by more than half of the distance. Bends of up to 11 degrees stay, and so do corners whose
/// curve would leave the polygon.
void round_corners(IntPath& path, double distance, const FillPolygon& polygon);

}  // namespace msq
