// SPDX-License-Identifier: Apache-2.0
// Finds the Voronoi edges that the seeds of a brick of cells own (edge_brick.h), cell by cell.
//
// The walk over tetrahedra (facet_walk.h) finds the edges of most bricks in less than half the
// time. This one stays for what that one refuses, since it needs no general position and no limit
// on the shape of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "structure/foam/edges/brick_cells.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class EdgeBuilder {
 public:
  /// Finds the edges owned by the brick of side^3 cells whose first is `corner`. wants_seeds: also
  /// fills seeds().
  void build(const FoamSeeds& seeds, CellIndex corner, int side, bool wants_seeds = false);

  // Results for the last brick.

  /// Vertices, relative to the brick's corner; a few belong to no edge.
  size_t vertex_count() const { return cells_.shared().count(); }
  Vec3 vertex(uint32_t number) const { return cells_.shared().position(number); }
  /// The vertices that each edge joins, in the order of their owners' cells.
  const std::vector<std::array<uint32_t, 2>>& ends() const { return ends_; }
  /// Where the edges that each row of cells along x owns begin.
  const std::vector<uint32_t>& starts() const { return starts_; }
  /// The three seeds to which each edge is equally near: the owner first, by numbers in block(). If
  /// they are not known, since more than three may be equally near, the owner three times.
  const std::vector<std::array<uint32_t, 3>>& seeds() const { return triples_; }
  const BrickSeeds& block() const { return cells_.block(); }

  /// Approximate memory.
  size_t bytes() const { return sizeof *this - sizeof cells_ + cells_.bytes(); }

 private:
  void add_owned_edges(size_t own);
  /// Returns false, and appends nothing, if the walk fails.
  bool add_by_walk(size_t own);
  bool add_by_cuts(size_t own);
  void add_by_definition(size_t own);
  void add_unknown(size_t own) {
    const auto number = static_cast<uint32_t>(own);
    if (wants_seeds_) triples_.push_back({number, number, number});
  }

  /// The number of a vertex.
  uint32_t take(Vec3 vertex) { return cells_.shared().take(vertex); }

  BrickCells cells_;
  std::vector<std::array<uint32_t, 2>> ends_;
  std::vector<uint32_t> starts_;
  bool has_jitter_ = false;
  bool wants_seeds_ = false;
  std::vector<std::array<uint32_t, 3>> triples_;
};

}  // namespace msq
