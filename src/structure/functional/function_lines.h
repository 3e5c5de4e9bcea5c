// SPDX-License-Identifier: Apache-2.0
// The lines in a plane of constant z on which the function of a functional structure is 0 (sheets:
// the middle of the walls) or its level (networks: the boundary), within the cells' shell or box.
#pragma once

#include "structure/common/line_graph.h"

namespace msq {

class Functional;

LineGraph find_function_lines(const Functional& structure, const WallSection& section);

}  // namespace msq
