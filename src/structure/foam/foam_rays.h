// SPDX-License-Identifier: Apache-2.0
// Rays through a foam: from slab to slab of cells, in packets of rays that stay close together.
#pragma once

#include <cstddef>

#include "base/ray.h"
#include "structure/foam/foam.h"

namespace msq {

/// Structure::enter for foams. False, and nothing is done, for those that have too many seeds near
/// a cell, and for rays that are not worth the edges about them (RayDemand).
bool enter_by_cells(const Foam& foam, RaySearch* searches, size_t count);
/// The same, whatever the rays are worth.
bool walk_cells(const Foam& foam, RaySearch* searches, size_t count);

}  // namespace msq
