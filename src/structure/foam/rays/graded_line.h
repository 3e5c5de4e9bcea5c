// SPDX-License-Identifier: Apache-2.0
// The lines of a graded foam's edges, for rays.
#pragma once

#include <array>

#include "structure/foam/rays/strut_entry.h"
#include "structure/foam/seeds/graded_seed_name.h"
#include "structure/foam/seeds/graded_seeds.h"

namespace msq {

/// The line of three seeds in their order, named from the cell `home`. The ends of its edge are not
/// known. Its bits do not depend on `home`.
StrutLine graded_line(const GradedSeeds& seeds, CellIndex home,
                      const std::array<GradedSeedName, 3>& names);

}  // namespace msq
