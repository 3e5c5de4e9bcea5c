// SPDX-License-Identifier: Apache-2.0
// The struts of a foam: edges of the Voronoi diagram between joints.
//
// The bricks of edges say where vertices are; struts follow from these alone. Three seeds that are
// not on a line and that two joints have in common belong to one edge, which joins them: the points
// equally far from all three, and no nearer to any other seed, are a segment. Its owner is the
// first of all seeds that the joints have in common, and the brick of that seed has both its
// joints.
#pragma once

#include <memory>

#include "structure/common/struts.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// Refers to the foam.
std::unique_ptr<StrutParts> foam_struts(const FoamData& foam, const StrutSelection& selection);

}  // namespace msq
