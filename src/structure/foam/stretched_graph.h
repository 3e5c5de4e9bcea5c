// SPDX-License-Identifier: Apache-2.0
// The graph of a foam whose cells are stretched (seeds/stretch.h), with one seed per cell.
#pragma once

#include "structure/foam/foam_graph.h"
#include "structure/foam/seeds/stretch.h"

namespace msq {

class StretchedGraph final : public FoamGraph {
 public:
  explicit StretchedGraph(const Stretch& stretch) : stretch_(stretch) {}

  bool inside(CellIndex cell, Vec3 q, double radius) const override;
  double onset(CellIndex cell, Vec3 q) const override;
  std::shared_ptr<const EdgeBrick> make_brick(CellIndex corner) const override;
  double brick_error() const override;
  double drawing_share() const override;

 private:
  const Stretch stretch_;
};

}  // namespace msq
