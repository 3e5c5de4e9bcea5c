// SPDX-License-Identifier: Apache-2.0
// The faces of the cells of a brick, from a walk over tetrahedra (edges/facet_walk.h).
#pragma once

#include <vector>

#include "structure/foam/edges/facet_cells.h"
#include "structure/foam/edges/facet_walk.h"
#include "structure/foam/walls/face_brick.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class FacetFaces {
 public:
  /// Appends the cells of the brick whose first is `corner`, in the order of seeds, as FaceBrick
  /// has them. `factor`: foam units of a FaceBrick in a unit of `seeds`, along each axis. Returns
  /// false, and appends nothing, if the walk gives up.
  bool build(const FoamSeeds& seeds, CellIndex corner, Vec3 factor,
             std::vector<FaceBrick::Cell>& cells, std::vector<FaceBrick::Face>& faces);

  size_t bytes() const { return sizeof *this; }

 private:
  FacetCells cells_;
  FacetCells::Cell cell_;
  FaceBrick::Face faces_[FacetCells::room + FacetCells::padding];
};

}  // namespace msq
