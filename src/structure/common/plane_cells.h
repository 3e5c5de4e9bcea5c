// SPDX-License-Identifier: Apache-2.0
// The cells of a grid about a window in a plane.
#pragma once

#include "base/vec.h"
#include "cell/neighbourhood.h"
#include "structure/common/line_graph.h"

namespace msq {

/// Throws Error(limit) if the section, or a cell next to it, is beyond max_cell_index.
void require_in_cells(const Neighbourhood& grid, const WallSection& section);
/// Throws Error(limit) if it is so far that its cells are no numbers: coordinates overflow.
void require_finite_cells(const Neighbourhood& grid, const WallSection& section);
/// The same as the first of a box in grid coordinates.
void require_in_cells(const Neighbourhood& grid, const Box3& box);

/// A linear map of grid coordinates.
struct GridMap {
  std::array<double, 9> m;  ///< rows of the matrix
  Vec3 origin;

  Vec3 of(Vec3 g) const { return Rotation{m}.apply(g) + origin; }
};
inline GridMap model_map(const Neighbourhood& grid) {
  return {grid.rotation.m, grid.origin};
}

/// Cells [first, last] along the first axis; none if first > last.
struct CellRow {
  double first, last;
};
/// The cells of a row whose images, grown by `slack` along each axis, may meet a box.
CellRow cells_in_row(const GridMap& map, Vec3 cell_size, const Box3& box, double slack,
                     double cell_y, double cell_z);

}  // namespace msq
