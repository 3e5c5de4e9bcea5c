// SPDX-License-Identifier: Apache-2.0
// Voronoi vertices handed from the cell that found them to the cells that come later.
//
// A vertex is one of four seeds' cells. The cells of a brick are found one after the other; each
// starts from the vertices that the earlier ones found, and finds a third of them itself.
#pragma once

#include <cstdint>
#include <vector>

#include "structure/foam/seed_block.h"
#include "structure/foam/voronoi_cell.h"

namespace msq {

class SharedVertices {
 public:
  /// Forgets all; for the seeds of a block's brick.
  void reset(const SeedBlock& block);

  /// Squared distance within which a seed's cell needs its neighbours, for the vertices known.
  double needed(size_t own) const {
    return 4 * lists_[number_[own]].most_squared * (1 + 1e-6);  // rounding
  }

  /// Gives a cell, refilled with all neighbours as far as needed(), the vertices known.
  void give(const SeedBlock& block, size_t own, VoronoiCell& cell);

  /// Takes the vertices that a cell found, also for the seeds after its own, whose planes come
  /// after the first `before`.
  void take(const SeedBlock& block, size_t own, uint32_t before, const VoronoiCell& cell);

  /// A vertex for no other cell; returns its number.
  uint32_t take(Vec3 position);

  /// After give() and take(): the numbers of the cell's vertices.
  const std::vector<uint32_t>& numbers() const { return numbers_; }
  /// Of vertex `number`, from the corner of the brick.
  Vec3 position(uint32_t number) const { return vertices_[number].position; }
  size_t count() const { return vertices_.size(); }

 private:
  struct Vertex {
    Vec3 position;
    uint32_t seeds[4];  // the finder's own, and those of its planes, anticlockwise
  };
  struct List {
    static constexpr uint32_t most = 62;
    double most_squared;  // distance of its vertices from the seed
    uint32_t count;
    uint32_t vertices[most + 1];  // vertex << 2 | which of its last three seeds the list is of
  };

  std::vector<Vertex> vertices_;
  std::vector<List> lists_;
  std::vector<uint32_t> numbers_;
  std::vector<uint16_t> number_;  // of a list, for each seed of the block
  std::vector<uint8_t> plane_;    // of the cell at hand, for each seed of the block
};

}  // namespace msq
