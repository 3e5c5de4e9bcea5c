// SPDX-License-Identifier: Apache-2.0
// For each cell that rays cross the struts that they may meet in it, for one batch of rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/simd.h"
#include "cell/cell_hash.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeded_edges.h"
#include "structure/foam/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

/// Edges come from the cell cache; lists are made of them anew for each batch, which costs less
/// than their room in the cache would.
class CellStruts {
 public:
  /// Turns to a foam; forgets all lists.
  void move_to(const Foam& foam);
  /// Forgets lists and edges.
  void forget();
  /// Whether so much is held that it is time to; whoever keeps lists decides when.
  bool is_full() const { return bricks_.size() >= most_bricks || used_chunks_ >= most_chunks; }

  /// Another number after lists were forgotten.
  uint64_t era() const { return era_; }

  /// Struts that may be met in a cell; foam units, from the cell's corner. Ids are for line(),
  /// unlike for unlike struts, until lists are forgotten.
  CapsuleView list(CellIndex cell);

  StrutLine line(const StrutEntries& entries, uint32_t id) const {
    return entries.line(*bricks_[id >> 16], id & 0xffff);
  }

 private:
  static constexpr size_t most_bricks = 4096, chunk_floats = size_t{1} << 16, most_chunks = 256;

  /// A brick found last among those whose numbers are alike in their last bits.
  struct Recent {
    CellIndex brick;
    const SeededEdges* edges = nullptr;
    uint32_t number = 0;
  };
  /// The values of a list component by component, each in whole vectors, and then its ids.
  struct List {
    CellIndex cell;
    uint32_t count = 0;
    uint64_t era = 0;  ///< when it was made
    const float* values = nullptr;
  };

  const Recent& find_brick(CellIndex brick);
  void find_bricks(CellIndex cell);
  void make_list(List& list);
  /// The list of a cell, or the place for it.
  List& find_list(CellIndex cell);
  /// Aligned to vectors.
  float* room(size_t floats);

  const Foam* foam_ = nullptr;
  uint64_t era_ = 0;
  double radius_ = 0;
  std::array<int, 3> reach_{};
  std::vector<std::shared_ptr<const SeededEdges>> bricks_;
  std::unordered_map<CellIndex, uint32_t, CellHash> brick_numbers_;
  Recent recent_[64];
  /// At least half of them free, and the free ones of an era that is over.
  std::vector<List> lists_;
  size_t list_count_ = 0;
  std::vector<AlignedFloats> chunks_;
  size_t used_chunks_ = 0, used_floats_ = chunk_floats;
  /// What a brick has for the list at hand.
  struct Source {
    const SeededEdges* brick;
    std::span<const uint16_t> edges;
    uint32_t first_id;
  };
  std::vector<Source> sources_;
};

}  // namespace msq
