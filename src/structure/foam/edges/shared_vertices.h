// SPDX-License-Identifier: Apache-2.0
// Passes Voronoi vertices from the cell that found them to later cells.
//
// A vertex belongs to the cells of four seeds. The cells of a brick are computed one after the
// other. Each starts from the vertices that earlier cells found, and finds a third of its vertices
// itself.
#pragma once

#include <cstdint>
#include <vector>

#include "structure/foam/edges/brick_seeds.h"
#include "structure/foam/edges/voronoi_cell.h"

namespace msq {

class SharedVertices {
 public:
  /// Forgets everything and prepares for the seeds of a block's brick.
  void reset(const BrickSeeds& block);

  /// Squared distance within which a seed's cell needs its neighbours, for the known vertices.
  double needed(size_t own) const {
    return 4 * lists_[number_[own]].max_squared * (1 + 1e-6);  // rounding
  }

  /// Gives the known vertices to a cell that is refilled with all neighbours up to needed().
  void give(const BrickSeeds& block, size_t own, VoronoiCell& cell);

  /// Takes the vertices that a cell found, also for the seeds after its own. The planes of those
  /// seeds come after the first `before`.
  void take(const BrickSeeds& block, size_t own, uint32_t before, const VoronoiCell& cell);

  /// Adds a vertex that no other cell uses; returns its number.
  uint32_t take(Vec3 position);

  /// After give() and take(): the numbers of the cell's vertices.
  const std::vector<uint32_t>& numbers() const { return numbers_; }
  /// Position of vertex `number`, relative to the corner of the brick.
  Vec3 position(uint32_t number) const { return vertices_[number].position; }
  size_t count() const { return vertices_.size(); }

  size_t bytes() const {
    return vertices_.capacity() * sizeof(Vertex) + lists_.capacity() * sizeof(List) +
           number_.capacity() * sizeof(uint16_t) + plane_.capacity();
  }

 private:
  struct Vertex {
    Vec3 position;
    uint32_t seeds[4];  // the finder's own seed, and the seeds of its planes, anticlockwise
  };
  struct List {
    static constexpr uint32_t most = 62;
    double max_squared;  // maximum distance of its vertices from the seed
    uint32_t count;
    uint32_t vertices[most + 1];  // vertex << 2 | index of the list's seed among its last three
  };

  std::vector<Vertex> vertices_;
  std::vector<List> lists_;
  std::vector<uint32_t> numbers_;
  std::vector<uint16_t> number_;  // of a list, for each seed of the block
  std::vector<uint8_t> plane_;    // of the current cell, for each seed of the block
};

}  // namespace msq
