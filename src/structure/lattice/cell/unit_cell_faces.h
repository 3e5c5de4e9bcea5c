// SPDX-License-Identifier: Apache-2.0
// Which nodes of unit cells meet nodes of the neighbouring cells.
#pragma once

#include <cstdint>
#include <vector>

#include "structure/lattice/cell/unit_cell.h"

namespace msq {

enum class Side { low, high };  // of an axis: at 0, at 1

/// The nodes of a cell on one of its faces, with or without struts.
std::vector<uint32_t> nodes_on_face(const UnitCell& cell, int axis, Side side);

/// Those of them that have no copy on the opposite face of `other`, the cell beyond the face.
std::vector<uint32_t> unmatched_nodes(const UnitCell& cell, int axis, Side side,
                                      const UnitCell& other);

}  // namespace msq
