// SPDX-License-Identifier: Apache-2.0
// Rays through a foam: from slab to slab of cells, in packets of rays that stay close together.
#pragma once

#include <cstddef>

#include "base/ray.h"
#include "structure/foam/foam.h"

namespace msq {

/// Structure::enter for foams. False, and nothing is done, for
/// those that have too many seeds near a cell, and for rays so far apart that each would need the
/// edges of cells of its own.
bool enter_by_cells(const Foam& foam, RaySearch* searches, size_t count);
/// The same, however far apart the rays are.
bool walk_cells(const Foam& foam, RaySearch* searches, size_t count);

}  // namespace msq
