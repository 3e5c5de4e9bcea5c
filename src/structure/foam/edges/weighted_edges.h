// SPDX-License-Identifier: Apache-2.0
// The edges of a power diagram that the seeds of a brick own (edge_brick.h), read from the cells of
// the seeds (weighted_cells.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "structure/foam/edges/weighted_cells.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class WeightedEdges {
 public:
  /// Finds the edges owned by the brick of side^3 cells whose first is `corner`.
  void build(const FoamSeeds& seeds, CellIndex corner, int side);

  // Results for the last brick.

  /// Relative to the brick's corner. The cells on either side of a vertex have their own copies.
  const std::vector<Vec3>& vertices() const { return vertices_; }
  /// The vertices that each edge joins, in the order of their owners' cells.
  const std::vector<std::array<uint32_t, 2>>& ends() const { return ends_; }
  /// Where the edges that each row of cells along x owns begin.
  const std::vector<uint32_t>& starts() const { return starts_; }

  /// Approximate memory.
  size_t bytes() const { return sizeof *this - sizeof cells_ + cells_.bytes(); }

 private:
  void add_walked(size_t own);
  void add_cell(size_t own);
  void add_by_definition(size_t own);
  uint32_t take(Vec3 vertex) {
    vertices_.push_back(vertex);
    return static_cast<uint32_t>(vertices_.size() - 1);
  }

  WeightedCells cells_;
  std::vector<Vec3> vertices_;
  std::vector<std::array<uint32_t, 2>> ends_;
  std::vector<uint32_t> starts_;
  std::vector<uint32_t> numbers_;  // in vertices_, of the vertices of a cell
};

}  // namespace msq
