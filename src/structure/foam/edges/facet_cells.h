// SPDX-License-Identifier: Apache-2.0
// The Voronoi cells of the seeds of a brick, from the facets that a walk over tetrahedra has found
// (facet_walk.h): the neighbours of each seed, and a box about the vertices of its cell.
#pragma once

#include <cstddef>
#include <cstdint>

#include "structure/foam/edges/facet_state.h"

namespace msq {

/// Works for one brick after another and reuses its memory: 52 kB.
class FacetCells {
 public:
  /// As many neighbours as there are cells within three cells of one.
  static constexpr size_t room = 7 * 7 * 7;
  /// Vectors of so many neighbours may be read beyond them.
  static constexpr size_t padding = 8;
  struct Cell {
    float low[3], high[3];  // foam units, from the middle of the brick
    float own[3];           // the seed, in cells, from the middle of the brick
    // Neighbours from the seed, in cells, exactly; each once.
    size_t count;
    float x[room + padding], y[room + padding], z[room + padding];
  };

  /// The brick of FacetState::max_side^3 cells that a walk has just finished.
  void find(const FacetState& state);
  /// After find(): of the seed of a cell of the brick. Coordinates of vertices are within 2^-22 of
  /// what the walk has found.
  void read(const FacetState& state, int x, int y, int z, Cell& cell) const;

 private:
  // The last one stands for all seeds out of the brick.
  static constexpr size_t seeds = FacetState::seeds_in_brick + 1;
  // Neighbours of each seed, by the last three bits of their cells' coordinates: word z, bit 8 y +
  // x.
  alignas(64) uint64_t neighbours_[seeds][8];
  alignas(64) float low_[seeds][4], high_[seeds][4];
};

}  // namespace msq
