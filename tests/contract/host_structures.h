// SPDX-License-Identifier: Apache-2.0
// Structures of a host for the contract suite: copies of msq's own lattices, by points and by
// cells, and a function.
#pragma once

#include "cell/context.h"
#include "field/field.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/structure.h"

namespace msq::test {

/// The points are asked of a lattice, and what msq says about their cells is checked.
Ref<const Structure> make_copy(Ref<Context> context, const UnitCell& cell,
                               const Neighbourhood& grid, Parameter radius, bool by_cell);

/// A gyroid by the C library's functions, which a Lipschitz constant or an interval about the
/// middle of a box bound: each derivative is at most 2.
Ref<const Structure> make_host_gyroid(const Neighbourhood& grid, Parameter level, bool is_sheet,
                                      bool has_range, double lipschitz);

}  // namespace msq::test
