// SPDX-License-Identifier: Apache-2.0
// Rays through a foam: from slab to slab of cells, in packets of rays that stay close together.
#pragma once

#include <cstddef>

#include "base/ray.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// Structure::enter for foams. Returns false and does nothing for foams with too many seeds near a
/// cell, for stretched ones, and for rays that are not worth their edges (RayDemand).
bool enter_by_cells(const FoamData& foam, RaySearch* searches, size_t count, const Job* job);
/// The same without RayDemand.
bool walk_cells(const FoamData& foam, RaySearch* searches, size_t count, const Job* job);

}  // namespace msq
