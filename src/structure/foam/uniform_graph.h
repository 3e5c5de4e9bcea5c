// SPDX-License-Identifier: Apache-2.0
// The graph of a foam with one seed per cell.
#pragma once

#include "structure/foam/foam_graph.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class UniformGraph final : public FoamGraph {
 public:
  explicit UniformGraph(const FoamSeeds& seeds) : seeds_(seeds) {}

  bool inside(CellIndex cell, Vec3 q, double radius) const override;
  double onset(CellIndex cell, Vec3 q) const override;
  std::shared_ptr<const EdgeBrick> make_brick(CellIndex corner) const override;
  bool has_parts() const override;
  std::shared_ptr<const EdgeBrick> make_part(CellIndex corner, const Owners& owners) const override;
  double brick_error() const override;

 private:
  const FoamSeeds seeds_;
};

}  // namespace msq
