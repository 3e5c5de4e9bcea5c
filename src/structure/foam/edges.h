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

/// Ends in foam units from the corner of the brick's first cell, in single precision. Owners lie
/// within the brick's 4 units and their edges within the empty radius, below 2, of them:
/// coordinates stay below 8, roundings below 2^-22 in each and 4.2e-7 together. The rest of
/// edge_error is for the vertices themselves, in double precision.
struct FoamEdge {
  float a[3], b[3];
};
constexpr double edge_error = 5e-7;

/// The edges owned by the seeds of a brick of cells.
class EdgeBrick final : public CellData {
 public:
  static constexpr int side = 4;  ///< cells

  /// The edges of one owner and a box that holds them.
  struct Group {
    uint32_t first, last;
    float low[3], high[3];
  };

  /// The brick whose first cell is `corner`.
  EdgeBrick(const FoamSeeds& seeds, CellIndex corner);

  const std::vector<FoamEdge>& edges() const { return edges_; }
  const std::vector<Group>& groups() const { return groups_; }
  uint64_t bytes() const override {
    return sizeof *this + edges_.capacity() * sizeof(FoamEdge) + groups_.capacity() * sizeof(Group);
  }

 private:
  std::vector<FoamEdge> edges_;
  std::vector<Group> groups_;
};

}  // namespace msq
