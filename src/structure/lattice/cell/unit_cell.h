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

/// A strut, or a plate, in model units.
template <class Axis>
struct LatticePart {
  Axis axis;
  double factor = 1;

  /// Whether it contains a point for radius r; this expression is the definition.
  bool holds(Vec3 q, double r) const {
    const double own = factor * r;
    return axis.distance_squared(q) <= own * own;
  }
};
using LatticeStrut = LatticePart<Segment>;

inline Box3 bounds_of(const Segment& s) {
  const Vec3 end = s.a + s.ab;
  return {min(s.a, end), max(s.a, end)};
}

/// One strut for each class of struts that are whole cells apart. Tiled, they give the lattice,
/// each strut once. In cell units; the first end lies in [0, 1).
struct PeriodicStrut {
  Vec3 a, b;
  double factor = 1;  ///< of the radius

  Vec3 low() const { return min(a, b); }
  Vec3 high() const { return max(a, b); }
  /// That of the cell at `shift`, in model units from the corner of cell 0.
  LatticeStrut placed(Vec3 shift, Vec3 cell_size) const {
    return {Segment((a + shift) * cell_size, (b + shift) * cell_size), factor};
  }
};
/// Of struts that are whole cells apart, the thickest counts. The thickest come first.
std::vector<PeriodicStrut> periodic_struts(const UnitCell& cell);

}  // namespace msq
