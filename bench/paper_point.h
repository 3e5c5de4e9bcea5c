// SPDX-License-Identifier: Apache-2.0
// The paper's naive point query of a Voronoi foam, as the paper has it: a baseline, for a solid
// that is not msq's.
#pragma once

#include "structure/foam/seeds/seeds.h"

namespace bench {

/// Whether a point (in cells, which are cubes) is in a flat-ended cylinder of radius r < 0.268
/// about an edge of the Voronoi cell of its nearest seed.
bool paper_point_inside(const msq::FoamSeeds& seeds, msq::Vec3 p, double r);

}  // namespace bench
