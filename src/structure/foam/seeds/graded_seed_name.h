// SPDX-License-Identifier: Apache-2.0
// Names of a graded foam's seeds. An edge stores names; the positions of the seeds follow from
// them.
#pragma once

#include <array>
#include <cstdint>

#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

/// The seed of a leaf: its cell, relative to a nearby cell, and its path there; or a placed seed.
struct GradedSeedName {
  std::array<int8_t, 3> cell;
  uint8_t level;
  uint16_t order;  ///< of GradedSeeds::Node, or the number
};
/// `offset`: from the home of the search that found the seed to the reference cell of names.
GradedSeedName name_of(const LeafSeed& seed, CellIndex offset = {});

struct NamedLeafSeed {
  CellIndex cell;
  Vec3 in_cell;  ///< position in the cell, whose box has size 1
  double size;   ///< of the leaf, in cells
};
/// The seed whose name refers to the cell `home`.
NamedLeafSeed seed_of(const GradedSeeds& seeds, CellIndex home, const GradedSeedName& name);

}  // namespace msq
