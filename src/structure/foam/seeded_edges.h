// SPDX-License-Identifier: Apache-2.0
// Edges with the seeds that make them, for rays: the single precision of an edge's ends tells which
// rays may meet it, its seeds tell where.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeds.h"
#include "strut/segment_set.h"

namespace msq {

/// The edges owned (edges.h) by the seeds of a brick of cells.
class SeededEdges final : public CellData {
 public:
  /// Cells along each axis: few, since rays end soon after they enter a foam.
  static constexpr int side = 4;

  SeededEdges(const FoamSeeds& seeds, CellIndex corner);

  /// In runs of the edges that a row of cells along x owns; foam units, from the corner of the
  /// brick's first cell.
  const SegmentSet& segments() const { return segments_; }

  /// A seed's cell, from the brick's first cell.
  struct Offset {
    int8_t x, y, z;
    friend bool operator==(Offset a, Offset b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  };
  /// An edge's three, the owner first; the owner thrice where they are not known.
  const std::array<Offset, 3>& seeds(size_t edge) const { return seeds_[edge]; }

  uint64_t bytes() const override {
    return sizeof *this + segments_.bytes() + seeds_.capacity() * sizeof seeds_[0];
  }

 private:
  SegmentSet segments_;
  std::vector<std::array<Offset, 3>> seeds_;
};

}  // namespace msq
