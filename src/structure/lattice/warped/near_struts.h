// SPDX-License-Identifier: Apache-2.0
// The struts near a cell, as they are kept in the cell cache.
#pragma once

#include <array>
#include <memory>

#include "cell/cache.h"
#include "structure/lattice/warped/placed_graph.h"
#include "strut/capsule_list.h"

namespace msq {

/// All struts that come within a distance of the bounds of a list, the thickest first, in grid
/// coordinates.
class NearStruts final : public CellData {
 public:
  /// `widened`: by how much the list's bounds are grown first. Stops by Error(cancelled) with the
  /// thread's job.
  NearStruts(const PlacedGraph& graph, CellIndex list, double widened, double reach);

  /// The bounds of the list, widened by half as much.
  const Box3& box() const { return box_; }
  const CapsuleList& struts() const { return struts_; }

  /// Whether a strut contains a point in grid coordinates, for radius r.
  bool holds(Vec3 q, double r) const;

  uint64_t bytes() const override { return sizeof *this + struts_.size() * 8 * sizeof(double); }

 private:
  Box3 box_;
  CapsuleList struts_;
};

}  // namespace msq
