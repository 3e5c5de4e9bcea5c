// SPDX-License-Identifier: Apache-2.0
// Edges with the seeds that make them, for rays: the single precision of an edge's ends tells which
// rays may meet it, its seeds tell where.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeds.h"
#include "strut/segment_set.h"

namespace msq {

/// A list of a cell holds the struts that come within this of it, in foam units.
constexpr double ray_list_margin = 0x1p-10;

/// The edges owned (edges.h) by the seeds of a brick of cells, and for each cell about them those
/// whose struts a ray may meet in it.
class SeededEdges final : public CellData {
 public:
  /// Cells along each axis: few, since rays end soon after they enter a foam. And where bricks
  /// begin in space: `lead` before cell 0, as those of EdgeBrick and for the same reason.
  static constexpr int side = 4, lead = 2;

  /// How many cells beyond the brick struts of a radius (foam units) may reach along each axis.
  static std::array<int, 3> reach(const FoamSeeds& seeds, double radius);

  SeededEdges(const FoamSeeds& seeds, CellIndex corner, double radius);

  /// Ends: foam units, from the corner of the brick's first cell.
  const SegmentSet& segments() const { return segments_; }

  /// A seed's cell, from the brick's first cell.
  struct Offset {
    int8_t x, y, z;
    friend bool operator==(Offset a, Offset b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  };
  /// An edge's three, the owner first; the owner thrice where they are not known.
  const std::array<Offset, 3>& seeds(size_t edge) const { return seeds_[edge]; }

  /// Numbers of the edges for the cell that lies (x, y, z) from the brick's first.
  std::span<const uint16_t> list(int x, int y, int z) const {
    const int cell[3] = {x, y, z};
    size_t bucket = 0;
    for (size_t axis = 3; axis-- > 0;) {
      const int at = cell[axis] + reach_[axis], size = side + 2 * reach_[axis];
      if (at < 0 || at >= size) return {};
      bucket = bucket * static_cast<size_t>(size) + static_cast<size_t>(at);
    }
    return {listed_.data() + starts_[bucket], starts_[bucket + 1] - starts_[bucket]};
  }

  uint64_t bytes() const override {
    return sizeof *this + segments_.bytes() + seeds_.capacity() * sizeof seeds_[0] +
           starts_.capacity() * sizeof starts_[0] + listed_.capacity() * sizeof listed_[0];
  }

 private:
  void list_edges(const FoamSeeds& seeds, double radius);

  SegmentSet segments_;
  std::vector<std::array<Offset, 3>> seeds_;
  std::array<int, 3> reach_;
  std::vector<uint32_t> starts_;
  std::vector<uint16_t> listed_;
};

}  // namespace msq
