// SPDX-License-Identifier: Apache-2.0
// The lines in a plane of constant z on which a sum of waves is 0 (sheets: the middle of the walls)
// or the level (networks: the boundary).
#pragma once

#include "structure/common/line_graph.h"

namespace msq {

class Waves;

LineGraph find_wave_lines(const Waves& structure, const WallSection& section);

}  // namespace msq
