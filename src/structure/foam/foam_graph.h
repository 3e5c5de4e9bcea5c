// SPDX-License-Identifier: Apache-2.0
// The Voronoi graph of a foam's seeds, with one seed per cell (UniformGraph; StretchedGraph for
// stretched cells, WeightedGraph for seeds with weights) or more (GradedGraph).
//
// Sets and points use a foam through this interface. Rays do not: they keep lists of edges for each
// cell, in a different form for each kind (rays/cell_lists.h, rays/graded_lists.h).
//
// The functions that have a default have that of one seed per cell.
#pragma once

#include <memory>

#include "base/vec.h"
#include "cell/neighbourhood.h"
#include "structure/foam/edges/owners.h"

namespace msq {

class EdgeBrick;

/// Cells and lengths are in foam units unless stated otherwise.
class FoamGraph {
 public:
  virtual ~FoamGraph() = default;

  /// The definition: whether the point q, from the corner of `cell`, is within `radius` of an edge.
  virtual bool inside(CellIndex cell, Vec3 q, double radius) const = 0;
  /// Distance from that point to the nearest edge.
  virtual double onset(CellIndex cell, Vec3 q) const = 0;

  /// Edges come in bricks of side^3 cells. Bricks begin `lead` cells before multiples of `side`.
  struct BrickLayout {
    int side, lead;
  };
  virtual BrickLayout brick_layout() const;
  /// The edges that the seeds of a brick own (edges/edge_brick.h).
  virtual std::shared_ptr<const EdgeBrick> make_brick(CellIndex corner) const = 0;
  /// Whether bricks of some of their seeds take less time. Then make_part() makes them.
  virtual bool has_parts() const { return false; }
  virtual std::shared_ptr<const EdgeBrick> make_part(CellIndex corner, const Owners& owners) const;
  /// Maximum error of an edge of a brick.
  virtual double brick_error() const = 0;
  /// Whether a brick may own edges that come into a box (grid coordinates, model units).
  virtual bool may_own_edges(CellIndex corner, const Box3& box) const;
  /// Samples per cell of a box (grid coordinates, model units) above which building and drawing the
  /// cells' edges costs less than evaluating every sample.
  virtual double critical_samples(const Box3& box, double max_radius) const;
  /// Of that number, the part that remains if the edges are there and only drawn.
  virtual double drawing_share() const;
};

}  // namespace msq
