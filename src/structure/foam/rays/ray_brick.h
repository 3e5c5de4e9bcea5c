// SPDX-License-Identifier: Apache-2.0
// Edges with their seeds, for rays. The ends of an edge, in single precision, decide which rays may
// meet it; its seeds give the exact entry.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/simd.h"
#include "cell/cache.h"
#include "structure/foam/rays/owning_bricks.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class BrickSeeds;
class EdgeBuilder;
class FacetWalk;

/// The list of a cell contains the struts that come within this distance of it, in foam units.
constexpr double ray_list_margin = 0x1p-10;

/// The edges owned (edge_brick.h) by the seeds of a brick of cells; and for each cell around them,
/// the edges whose struts a ray may meet in it.
class RayBrick final : public CellData {
 public:
  /// Cells along each axis: few, since rays end soon after they enter a foam. Bricks begin `lead`
  /// before multiples of `side`, like those of EdgeBrick and for the same reason.
  static constexpr int side = owning_bricks_side, lead = 2;

  /// The number, along an axis, of the brick that contains a cell.
  static constexpr int brick_of(int cell) {
    const int place = cell + lead;
    return place >= 0 ? place / side : -((side - 1 - place) / side);
  }

  /// Whether numbers of seeds and cells fit their bits: they do not if cells are too flat or long.
  static bool fits(const FoamSeeds& seeds);
  /// How many cells beyond the brick struts of a radius (foam units) may reach along each axis.
  static std::array<int, 3> reach(const FoamSeeds& seeds, double radius);

  RayBrick(const FoamSeeds& seeds, CellIndex corner, double radius);

  CellIndex corner() const { return corner_; }
  size_t count() const { return edges_.size(); }
  /// The cell whose corner is in the middle of the brick.
  CellIndex middle() const {
    constexpr int half = side / 2;
    return {corner_.x + half, corner_.y + half, corner_.z + half};
  }
  /// An end of an edge, 0 or 1: foam units, from the middle of the brick.
  const std::array<float, 3>& end(size_t edge, size_t which) const {
    return nodes_[edges_[edge].ends[which]];
  }
  /// Whether its three seeds are known; and their cells, in the order of seeds.
  bool knows_seeds(size_t edge) const { return edges_[edge].seeds != no_seeds; }
  std::array<CellIndex, 3> seeds(size_t edge) const;

  /// The bricks that may own edges that come near a cell of this one, as the bits of
  /// find_owning_bricks(). Seeds and radius: those that the brick was made of.
  uint8_t owning(const FoamSeeds& seeds, double radius, int x, int y, int z) const;

  /// Numbers of the edges for the cell at (x, y, z) relative to the brick's first.
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

  /// Begins to load the edges, which are read in any order, from main memory.
  HWY_INLINE void prefetch() const {
    prefetch_all(edges_.data(), edges_.size() * sizeof edges_[0]);
    prefetch_all(nodes_.data(), nodes_.size() * sizeof nodes_[0]);
  }

  uint64_t bytes() const override {
    return sizeof *this + nodes_.capacity() * sizeof nodes_[0] +
           edges_.capacity() * sizeof edges_[0] + starts_.capacity() * sizeof starts_[0] +
           listed_.capacity() * sizeof listed_[0];
  }

 private:
  static constexpr uint32_t no_seeds = UINT32_MAX;
  /// Maximum distance of seeds' cells from their owner's along each axis; farther ones are not
  /// stored.
  static constexpr int max_apart = 7;
  struct Edge {
    std::array<uint16_t, 2> ends;
    /// Six bits for the owner's cell, x first; then, for each of the two others, four bits per axis
    /// for its cell relative to that.
    uint32_t seeds;
  };

  void build_by_facets(const FacetWalk& walk);
  void build_by_cells(const EdgeBuilder& builder, Vec3 scale);
  static uint32_t pack_seeds(const int (&owner)[3], const int (&others)[2][3]);
  static uint32_t pack_seeds(const BrickSeeds& block, const std::array<uint32_t, 3>& triple);
  void list_edges(const FoamSeeds& seeds, double radius);

  CellIndex corner_;
  std::vector<std::array<float, 3>> nodes_;
  std::vector<Edge> edges_;
  std::array<int, 3> reach_;
  std::vector<uint32_t> starts_;
  std::vector<uint16_t> listed_;
  /// Of each eighth of the brick, 0 until first wanted: rays rarely cross all of a brick.
  mutable std::array<std::atomic<uint64_t>, 8> owning_{};
};

}  // namespace msq
