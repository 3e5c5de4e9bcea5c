// SPDX-License-Identifier: Apache-2.0
// Unit cells of strut lattices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/hash_input.h"
#include "base/vec.h"
#include "strut/segment.h"

namespace msq {

/// Nodes closer than this, in cell units, are one node of the tiling.
constexpr double same_node = 1e-9;

/// Nodes in the unit cube and struts between them.
struct UnitCell {
  std::vector<Vec3> nodes;
  std::vector<std::array<uint32_t, 2>> struts;
  std::vector<double> factors;  ///< of the radius, one per strut; empty: all 1

  double factor(size_t strut) const { return factors.empty() ? 1 : factors[strut]; }
  void describe(HashInput& input) const;
};

// Named cells; unit_cell_presets.cpp describes them and gives their sources.
UnitCell cubic_unit_cell();
UnitCell bcc_unit_cell();
UnitCell octet_unit_cell();
UnitCell fcc_unit_cell();
UnitCell kelvin_unit_cell();
UnitCell diamond_unit_cell();
UnitCell rhombic_dodecahedron_unit_cell();
UnitCell reentrant_unit_cell();

/// One strut for each class of struts that are whole cells apart. Tiled, they give the lattice,
/// each strut once. In cell units; the first end lies in [0, 1).
struct PeriodicStrut {
  Vec3 a, b;
  double factor = 1;  ///< of the radius
};
/// Of struts that are whole cells apart, the thickest counts. The thickest come first.
std::vector<PeriodicStrut> periodic_struts(const UnitCell& cell);

/// A strut in model units.
struct LatticeStrut {
  Segment axis;
  double factor = 1;

  /// Whether the strut contains a point for radius r; this expression is the definition.
  bool holds(Vec3 q, double r) const {
    const double own = factor * r;
    return axis.distance_squared(q) <= own * own;
  }
};

}  // namespace msq
