// SPDX-License-Identifier: Apache-2.0
// The lines in a plane of constant z on which the host's function is 0 (sheets: the middle of the
// walls) or its level (networks: the boundary).
#pragma once

#include "structure/common/line_graph.h"

namespace msq {

class HostFunction;

LineGraph find_host_function_lines(const HostFunction& structure, const WallSection& section);

}  // namespace msq
