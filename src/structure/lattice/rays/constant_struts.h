// SPDX-License-Identifier: Apache-2.0
// Where rays enter struts of constant radius in cells that are all equal: what StrutRays finds, to
// the last bit, compiled as a whole for each instruction set.
#pragma once

#include "structure/lattice/rays/part_lists.h"

namespace msq {

/// As StrutRays::enter(). The job may be null.
void enter_constant_struts(const Structure& structure, const CellParts& parts, double radius,
                           RaySearch* searches, size_t count, const Job* job);

}  // namespace msq
