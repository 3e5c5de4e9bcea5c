// SPDX-License-Identifier: Apache-2.0
// The edges of a graded foam's Voronoi diagram, in bricks as those of other foams (edges.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/foam/edges.h"
#include "structure/foam/graded_line.h"
#include "structure/foam/graded_seeds.h"

namespace msq {

/// The edges owned by the seeds of the brick of seeds.brick_side()^3 cells whose first is `corner`.
std::shared_ptr<const EdgeBrick> graded_edge_brick(const std::shared_ptr<const GradedSeeds>& seeds,
                                                   CellIndex corner);

/// An edge with the seeds that make it, for rays.
struct GradedEdge {
  std::array<float, 3> a, b;            ///< foam units, from the corner of the brick's first cell
  std::array<GradedSeedName, 3> seeds;  ///< from the brick's first cell, in their order, if known
  bool knows_seeds;
};

/// The same edges, by themselves.
class GradedEdges final : public CellData {
 public:
  explicit GradedEdges(std::vector<GradedEdge> edges) : edges_(std::move(edges)) {}

  const std::vector<GradedEdge>& edges() const { return edges_; }
  uint64_t bytes() const override { return sizeof *this + edges_.capacity() * sizeof(GradedEdge); }

 private:
  std::vector<GradedEdge> edges_;
};
std::shared_ptr<const GradedEdges> graded_edges(const std::shared_ptr<const GradedSeeds>& seeds,
                                                CellIndex corner);

}  // namespace msq
