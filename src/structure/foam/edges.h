// SPDX-License-Identifier: Apache-2.0
// The edges of a foam's Voronoi diagram, each once.
//
// An edge belongs to the first of its three seeds by cell (z, then y, then x), its owner. The edges
// that bricks of cells own, together, are all edges of the diagram, none twice.
#pragma once

#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeds.h"

namespace msq {

struct FoamEdge {
  Vec3 a, b;  ///< ends: foam units, from the corner of the brick's first cell
};

/// The edges owned by the seeds of a brick of cells.
class EdgeBrick final : public CellData {
 public:
  static constexpr int side = 4;  ///< cells

  /// The brick whose first cell is `corner`.
  EdgeBrick(const FoamSeeds& seeds, CellIndex corner);

  const std::vector<FoamEdge>& edges() const { return edges_; }
  uint64_t bytes() const override {
    return sizeof *this + edges_.capacity() * sizeof(FoamEdge);
  }

 private:
  std::vector<FoamEdge> edges_;
};

}  // namespace msq
