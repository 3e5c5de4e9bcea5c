// SPDX-License-Identifier: Apache-2.0
// Angles and radii of many points in warped cells, in vectors, with the bits of the scalar map.
#pragma once

#include "cell/warp.h"
#include "expression/batch.h"

namespace msq {

/// Warp::place(), Warp::locate() and angle_of(), to the last bit. x, y, z, the angles and the radii
/// are `count` values, readable and writable up to batch_padding beyond; uniform coordinates are
/// allowed.
void find_warped_places(const Warp& warp, Values x, Values y, Values z, size_t count,
                        double* const (&angles)[3], double* radii);

}  // namespace msq
