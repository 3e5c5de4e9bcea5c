// SPDX-License-Identifier: Apache-2.0
// The faces of a foam's Voronoi diagram, cut by a plane of constant z.
#pragma once

#include "structure/common/line_graph.h"
#include "structure/foam/section/section_seeds.h"

namespace msq {

/// Each line once. Corners have the same bits in every window.
LineGraph foam_section(const SectionFoam& foam, const WallSection& section);

}  // namespace msq
