// SPDX-License-Identifier: Apache-2.0
// The lines of a graded foam's edges, for rays.
#pragma once

#include <array>
#include <cstdint>

#include "structure/foam/graded_seeds.h"
#include "structure/foam/seed_trees.h"
#include "structure/foam/strut_entry.h"

namespace msq {

/// The seed of a leaf, by its cell, from another one near by, and its path there.
struct GradedSeedName {
  std::array<int8_t, 3> cell;
  uint8_t level;
  uint16_t order;  ///< of GradedSeeds::Node
};
/// `offset`: from the home of the search that found the seed to the cell that names are from.
GradedSeedName name_of(const LeafSeed& seed, CellIndex offset = {});

/// The line of three seeds in their order, named from the cell `home`; its edge's ends are not
/// known. The same bits whatever cell is home.
StrutLine graded_line(const GradedSeeds& seeds, CellIndex home,
                      const std::array<GradedSeedName, 3>& names);

}  // namespace msq
