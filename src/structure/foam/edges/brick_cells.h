// SPDX-License-Identifier: Apache-2.0
// The Voronoi cells of the seeds of a brick, one after another: by a walk, or plane by plane.
// Edges (edge_builder.h) and walls (walls/face_brick.cpp) are read from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/edges/brick_seeds.h"
#include "structure/foam/edges/clipped_cell.h"
#include "structure/foam/edges/shared_vertices.h"
#include "structure/foam/edges/voronoi_cell.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class BrickCells {
 public:
  struct Neighbour {
    Vec3 position;  // relative to the own seed
    double distance_squared;
    bool after;  // its seed comes after the own one
  };

  /// Goes to the brick of side^3 cells whose first is `corner`.
  void move_to(const FoamSeeds& seeds, CellIndex corner, int side);

  /// Finds the cell of a seed of the brick by a walk: walked(), and its vertices in shared().
  /// Returns how many of its planes belong to seeds before the own one, or -1 if the walk fails.
  int64_t walk(size_t own);

  /// Finds the cell by cuts: clipped(). Returns false if rounding defeats that. Either way
  /// neighbours() has all seeds that may matter, from near to far.
  bool cut(size_t own);

  const BrickSeeds& block() const { return block_; }
  SharedVertices& shared() { return shared_; }
  const SharedVertices& shared() const { return shared_; }
  const VoronoiCell& walked() const { return cell_; }
  const ClippedCell& clipped() const { return clipped_; }
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }
  /// Greatest distance of a point of a cell from its seed.
  double empty_radius() const { return empty_radius_; }

  /// Approximate memory.
  size_t bytes() const { return sizeof *this + block_.bytes() + shared_.bytes(); }

 private:
  void find_neighbours(size_t own);

  BrickSeeds block_;
  SharedVertices shared_;
  VoronoiCell cell_;
  ClippedCell clipped_;
  std::vector<Neighbour> neighbours_;
  double first_squared_ = 0;
  double empty_radius_ = 0;
  double max_squared_ = 0;  // twice that, squared
};

}  // namespace msq
