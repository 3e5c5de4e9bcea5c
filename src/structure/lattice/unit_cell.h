// SPDX-License-Identifier: Apache-2.0
// Unit cells of strut lattices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

/// Nodes in the unit cube and struts between them.
struct UnitCell {
  std::vector<Vec3> nodes;
  std::vector<std::array<uint32_t, 2>> struts;
};

UnitCell cubic_unit_cell();
UnitCell bcc_unit_cell();
/// Deshpande, Fleck and Ashby, "Effective properties of the octet-truss lattice material", 2001.
UnitCell octet_unit_cell();

/// One strut of each class of struts that are whole cells apart: tiled, they give the lattice, each
/// strut once. In cell units; the first end lies in [0, 1).
struct PeriodicStrut {
  Vec3 a, b;
};
std::vector<PeriodicStrut> periodic_struts(const UnitCell& cell);

}  // namespace msq
