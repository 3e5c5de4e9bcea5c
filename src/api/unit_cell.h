// SPDX-License-Identifier: Apache-2.0
// The unit cells of a host's definitions.
#pragma once

#include "msq.h"
#include "structure/lattice/cell/unit_cell.h"

namespace msq::api {

/// Nodes, and struts, of all unit cells of a lattice.
constexpr uint64_t max_custom = 4096;

msq_unit_cell_def unit_cell_defaults();

/// Throws Error(argument) where the cell makes no sense.
UnitCell read_unit_cell(const msq_unit_cell_def& def);

}  // namespace msq::api
