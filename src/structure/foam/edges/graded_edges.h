// SPDX-License-Identifier: Apache-2.0
// The edges of a graded foam's Voronoi diagram, in bricks like those of other foams (edge_brick.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/seeds/graded_seed_name.h"
#include "structure/foam/seeds/graded_seeds.h"

namespace msq {

/// The edges owned by the seeds of the brick of seeds.brick_side()^3 cells whose first is `corner`.
std::shared_ptr<const EdgeBrick> graded_edge_brick(const std::shared_ptr<const GradedSeeds>& seeds,
                                                   CellIndex corner);

/// Whether edges know their seeds at all. Without jitter four seeds are equally far from an edge,
/// of placed ones up to the rounding of their places: the walk would take any three of them.
bool names_edge_seeds(const GradedSeeds& seeds);

/// An edge with its three seeds, for rays.
struct GradedEdge {
  std::array<float, 3> a, b;            ///< foam units, from the corner of the brick's first cell
  std::array<GradedSeedName, 3> seeds;  ///< relative to the brick's first cell, in seed order, if
                                        ///< known
  bool knows_seeds;
};

/// The same edges as a list.
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
