// SPDX-License-Identifier: Apache-2.0
// The plates of a lattice, cut by a plane of constant z.
#pragma once

#include <vector>

#include "cell/neighbourhood.h"
#include "structure/common/line_graph.h"
#include "structure/lattice/cell/plate_cell.h"

namespace msq {

/// Each line once. Plates in the plane itself have none; where plates end at the plane, those that
/// come from below have a line along their rim. Corners have the same bits in every window.
LineGraph find_plate_lines(const std::vector<PeriodicPlate>& plates, const Neighbourhood& grid,
                           const WallSection& section);

}  // namespace msq
