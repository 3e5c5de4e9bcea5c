// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam that may own a part of a plane of constant z.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/memory.h"
#include "cell/context.h"
#include "structure/common/line_graph.h"
#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

/// A seed as the plane sees it. A point v of the plane is at the squared distance
/// |v - position|^2 + weight from it.
struct SectionSeed {
  Vec2 position;  ///< model coordinates
  double weight;  ///< squared distance from the plane
};

/// In the order of seeds: by cell (z, y, x of the grid), then by path in the tree of the cell. So
/// two seeds have the same order in every window.
struct SectionSeeds {
  double reach = 0;  ///< no point of the plane is farther from its nearest seed
  std::vector<SectionSeed> seeds;
  Reservation memory;
};

/// The foam whose seeds are sought, with struts or walls.
struct SectionFoam {
  Context& context;
  const Neighbourhood& grid;
  const FoamSeeds& seeds;
  const std::shared_ptr<const GradedSeeds>& graded;  ///< null where there is one seed in each cell
  double unit;                                       ///< length of a foam unit in model units
};

/// All seeds within 3 reach of a window that may be nearest to a point of the plane: those whose
/// part of the plane meets the window (within 1 reach), and all that bound those (within 2 more).
/// Throws Error(limit) where there are too many.
SectionSeeds find_section_seeds(const SectionFoam& foam, double z, const Box2& window);

}  // namespace msq
