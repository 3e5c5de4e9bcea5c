// SPDX-License-Identifier: Apache-2.0
// The plates that rows of samples along an axis of the grid may meet.
#pragma once

#include <array>
#include <vector>

#include "structure/lattice/cell/plate_cell.h"
#include "structure/lattice/rows/row_parts.h"

namespace msq {

/// A plate and its copies, a whole number of cells apart along the rows. Coordinates: along the
/// rows, across them, across the layers; model units, from a corner of the cell.
struct RowPlate {
  PlateTriangle triangle;
  Box3 bounds;    ///< of the triangle
  double factor;  ///< of the thickness: half that of the plate

  friend bool operator==(const RowPlate& one, const RowPlate& other) {
    return one.triangle.a() == other.triangle.a() && one.triangle.b() == other.triangle.b() &&
           one.triangle.c() == other.triangle.c() && one.factor == other.factor;
  }
};

struct RowPlates final : RowParts {
  std::vector<RowPlate> plates;

  /// The plates that reach rows through the cell if the thickness is at most `most`. axis[i]: the
  /// axis of the grid parallel to coordinate i. `error`: of the plates' distances.
  RowPlates(const std::vector<PeriodicPlate>& periodic, Vec3 cell_size, std::array<int, 3> axis,
            double most, double error);
  void mark_inside(const RowTask& task, std::vector<LeftSample>& left) const override;
  bool draws_as(const RowParts& other) const override;
  std::unique_ptr<const RowParts> copy() const override;
  size_t bytes() const override { return plates.capacity() * sizeof(RowPlate); }
};

}  // namespace msq
