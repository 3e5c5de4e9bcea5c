// SPDX-License-Identifier: Apache-2.0
// The edges of a foam's Voronoi diagram, each once.
//
// An edge belongs to the first of its three seeds by cell (z, then y, then x), its owner. The edges
// that bricks of cells own, together, are all edges of the diagram, none twice.
#pragma once

#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeds.h"
#include "strut/segment_set.h"

namespace msq {

/// Ends in foam units from the corner of the brick's first cell, in single precision. Owners lie
/// within the brick's 4 units and their edges within the empty radius, below 2, of them:
/// coordinates stay below 8, roundings below 2^-22 in each and 4.2e-7 together. The rest of
/// edge_error is for the vertices themselves, in double precision.
using FoamEdge = FloatSegment;
constexpr double edge_error = 5e-7;

/// The edges owned by the seeds of a brick of cells.
class EdgeBrick final : public CellData {
 public:
  static constexpr int side = 4;  ///< cells

  /// The brick whose first cell is `corner`.
  EdgeBrick(const FoamSeeds& seeds, CellIndex corner);
  /// Of edges that are found another way, in runs as SegmentSet has them.
  EdgeBrick(const std::vector<FoamEdge>& edges, const std::vector<uint32_t>& starts)
      : segments_(edges, starts) {}

  /// In runs of the edges that a row of cells along x owns.
  const SegmentSet& segments() const { return segments_; }
  /// A copy, edge by edge.
  std::vector<FoamEdge> edges() const;
  uint64_t bytes() const override { return sizeof *this + segments_.bytes(); }

 private:
  SegmentSet segments_;
};

}  // namespace msq
