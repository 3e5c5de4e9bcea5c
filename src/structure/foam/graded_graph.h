// SPDX-License-Identifier: Apache-2.0
// The graph of a foam whose cells have more seeds where the density is higher.
#pragma once

#include "structure/foam/foam_graph.h"
#include "structure/foam/seeds/graded_seeds.h"

namespace msq {

class GradedGraph final : public FoamGraph {
 public:
  explicit GradedGraph(std::shared_ptr<const GradedSeeds> seeds) : seeds_(std::move(seeds)) {}

  bool inside(CellIndex cell, Vec3 q, double radius) const override;
  double onset(CellIndex cell, Vec3 q) const override;
  BrickLayout brick_layout() const override { return {seeds_->brick_side(), 0}; }
  std::shared_ptr<const EdgeBrick> make_brick(CellIndex corner) const override;
  double brick_error() const override;
  bool may_own_edges(CellIndex corner, const Box3& box) const override {
    return seeds_->may_own_edges(corner, box);
  }
  double critical_samples(const Box3& box, double max_radius) const override;
  double drawing_share() const override;

 private:
  const std::shared_ptr<const GradedSeeds> seeds_;
};

}  // namespace msq
