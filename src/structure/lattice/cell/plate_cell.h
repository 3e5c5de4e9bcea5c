// SPDX-License-Identifier: Apache-2.0
// Unit cells of plate lattices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/hash_input.h"
#include "base/vec.h"
#include "structure/lattice/cell/plate_triangle.h"
#include "structure/lattice/cell/unit_cell.h"

namespace msq {

/// Nodes in the unit cube and triangles between them.
struct PlateCell {
  std::vector<Vec3> nodes;
  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<double> factors;  ///< of the thickness, one per face; empty: all 1

  double factor(size_t face) const { return factors.empty() ? 1 : factors[face]; }
  void describe(HashInput& input) const;
};

// Named cells; plate_presets.cpp describes them and gives their sources.
PlateCell cubic_plate_cell();
PlateCell bcc_plate_cell();
PlateCell fcc_plate_cell();
PlateCell cubic_octet_plate_cell();
PlateCell kelvin_plate_cell();

/// A plate in model units. Its radius is half of its thickness.
using LatticePlate = LatticePart<PlateTriangle>;

/// One plate for each class of plates that are whole cells apart, as PeriodicStrut.
struct PeriodicPlate {
  Vec3 a, b, c;
  double factor = 1;  ///< of the thickness

  Vec3 low() const { return min(a, min(b, c)); }
  Vec3 high() const { return max(a, max(b, c)); }
  LatticePlate placed(Vec3 shift, Vec3 cell_size) const {
    return {
        PlateTriangle((a + shift) * cell_size, (b + shift) * cell_size, (c + shift) * cell_size),
        factor};
  }
};
/// Of plates that are whole cells apart, the thickest counts. The thickest come first.
std::vector<PeriodicPlate> periodic_plates(const PlateCell& cell);

}  // namespace msq
