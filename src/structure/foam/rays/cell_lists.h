// SPDX-License-Identifier: Apache-2.0
// For each cell that rays cross, the struts that they may meet in it, for one batch of rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/simd.h"
#include "cell/cell_hash.h"
#include "structure/foam/foam_data.h"
#include "structure/foam/rays/ray_brick.h"
#include "structure/foam/rays/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

/// Edges come from the cell cache. Lists are made from them for each batch, which costs less than
/// keeping them in the cache would.
class CellLists {
 public:
  /// Moves to a foam; forgets all lists.
  void move_to(const FoamData& foam);
  /// Forgets lists and edges.
  void forget();
  /// Whether it is time to forget, because too much is held. The owner of the lists decides when.
  bool is_full() const { return bricks_.size() >= max_bricks || used_chunks_ >= max_chunks; }

  /// A number that changes when lists are forgotten.
  uint64_t era() const { return era_; }

  /// Struts that a ray may meet in a cell; foam units, from the cell's corner. Ids are for line().
  /// They are unique until lists are forgotten.
  CapsuleView list(CellIndex cell);

  StrutLine line(const StrutEntries& entries, uint32_t id) const {
    return entries.line(*bricks_[id >> 16], id & 0xffff);
  }

 private:
  static constexpr size_t max_bricks = 4096, chunk_floats = size_t{1} << 16, max_chunks = 256;

  /// The brick found last among those whose numbers have the same last bits.
  struct Recent {
    CellIndex brick;
    const RayBrick* edges = nullptr;
    uint32_t number = 0;
  };
  /// The values of a list component by component, each in whole vectors, followed by its ids.
  struct List {
    CellIndex cell;
    uint32_t count = 0;
    uint64_t era = 0;  ///< when it was made
    const float* values = nullptr;
  };

  const Recent& find_brick(CellIndex brick);
  void find_bricks(CellIndex cell);
  void make_list(List& list);
  /// The list of a cell, or the slot for it.
  List& find_list(CellIndex cell);
  /// Aligned to vectors.
  float* room(size_t floats);

  const FoamData* foam_ = nullptr;
  uint64_t era_ = 0;
  double radius_ = 0;
  std::array<int, 3> reach_{};
  std::vector<std::shared_ptr<const RayBrick>> bricks_;
  std::unordered_map<CellIndex, uint32_t, CellHash> brick_numbers_;
  Recent recent_[64];
  /// At least half of them are free; free ones have an older era.
  std::vector<List> lists_;
  size_t list_count_ = 0;
  std::vector<AlignedFloats> chunks_;
  size_t used_chunks_ = 0, used_floats_ = chunk_floats;
  /// The part of a brick in the current list.
  struct Source {
    const RayBrick* brick;
    std::span<const uint16_t> edges;
    uint32_t first_id;
  };
  std::vector<Source> sources_;
};

}  // namespace msq
